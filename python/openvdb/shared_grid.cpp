// The module pdc._openvdb: lends grids of pyopenvdb without a copy. Boost.Python keeps what it knows of classes in its
// shared library, so that whoever links that can take objects of another module; what they hold must come from the same
// OpenVDB. Kept apart from pdc._core, which can do without either.
#include <openvdb/openvdb.h>

#include <boost/python/extract.hpp>

namespace {

/// As pdc::python::fromCapsule() takes it.
constexpr auto kCapsule = "openvdb::GridBase::Ptr";

void release(PyObject* capsule) {
  delete static_cast<openvdb::GridBase::Ptr*>(PyCapsule_GetPointer(capsule, kCapsule));
}

/// Shares a grid that a Python object owns, which lives as long.
openvdb::GridBase::Ptr lend(openvdb::GridBase& grid, PyObject* owner) {
  Py_INCREF(owner);
  return {&grid, [owner](openvdb::GridBase*) {
            const PyGILState_STATE state = PyGILState_Ensure();
            Py_DECREF(owner);
            PyGILState_Release(state);
          }};
}

template <typename... GridT>
openvdb::GridBase::Ptr extract(PyObject* object, openvdb::TypeList<GridT...>) {
  openvdb::GridBase* grid = nullptr;
  const auto tryType = [&](auto* type) {
    using Grid = std::remove_pointer_t<decltype(type)>;
    const boost::python::extract<Grid&> found(object);
    if (grid == nullptr && found.check()) grid = &found();
  };
  (tryType(static_cast<GridT*>(nullptr)), ...);
  return grid == nullptr ? nullptr : lend(*grid, object);
}

/// A capsule that shares the grid, or None for what is no grid of scalars of pyopenvdb.
PyObject* share(PyObject*, PyObject* object) {
  using Grids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid,
                                  openvdb::BoolGrid>;
  const openvdb::GridBase::Ptr grid = extract(object, Grids{});
  if (!grid) Py_RETURN_NONE;
  return PyCapsule_New(new openvdb::GridBase::Ptr(grid), kCapsule, &release);
}

PyMethodDef gMethods[] = {{"share", &share, METH_O, nullptr}, {nullptr, nullptr, 0, nullptr}};
PyModuleDef gModule = {PyModuleDef_HEAD_INIT, "_openvdb", nullptr, -1, gMethods, nullptr, nullptr, nullptr, nullptr};

}  // namespace

PyMODINIT_FUNC PyInit__openvdb() { return PyModule_Create(&gModule); }
