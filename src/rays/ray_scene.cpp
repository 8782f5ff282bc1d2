#include "rays/ray_scene.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <limits>

#include "pdc/error.h"

namespace pdc::detail {

struct RayScene::Impl {
  Impl() : device(rtcNewDevice("")) {
    if (device == nullptr)
      throw Error(fmt::format("the ray caster does not start, Embree's error {}", int(rtcGetDeviceError(nullptr))));
    scene = rtcNewScene(device);
  }
  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  RTCDevice device;
  RTCScene scene = nullptr;
};

RayScene::RayScene(std::span<const Vec3f> positions, std::span<const Triangle> triangles)
    : mImpl(std::make_unique<Impl>()) {
  const RTCGeometry geometry = rtcNewGeometry(mImpl->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0, sizeof(Vec3f),
                             positions.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0,
                             sizeof(Triangle), triangles.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(mImpl->scene, geometry);
  rtcReleaseGeometry(geometry);
  // Otherwise rays slip through between two triangles.
  rtcSetSceneFlags(mImpl->scene, RTC_SCENE_FLAG_ROBUST);
  // One thread builds the tree, because which of two triangles at one distance a ray meets depends on the tree, and the
  // tree on the threads that build it.
  tbb::task_arena alone(1);
  alone.execute([&] { rtcJoinCommitScene(mImpl->scene); });
  const RTCError error = rtcGetDeviceError(mImpl->device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) throw Error(fmt::format("the ray caster fails, Embree's error {}", int(error)));
}

RayScene::~RayScene() = default;

RayHit RayScene::hit(const Vec3f& origin, const Vec3f& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit ray{};
  ray.ray.org_x = origin.x;
  ray.ray.org_y = origin.y;
  ray.ray.org_z = origin.z;
  ray.ray.dir_x = direction.x;
  ray.ray.dir_y = direction.y;
  ray.ray.dir_z = direction.z;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(mImpl->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {true, ray.ray.tfar, ray.hit.primID, ray.hit.u, ray.hit.v};
}

bool RayScene::blocked(const Vec3f& origin, const Vec3f& direction, float reach) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = reach;
  ray.mask = ~0U;
  rtcOccluded1(mImpl->scene, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace pdc::detail
