#include "pdc/tile/slab_folder.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "io/file/atomic_file.h"
#include "io/file/file_error.h"
#include "io/file/read_file.h"
#include "math/hash128.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kPlanVersion = 1;
constexpr const char* kPlanName = "plan.json";

/// How many slabs a file's name counts to, and a plan has at most.
constexpr std::size_t kMostSlabs = 100000;

Json toJson(const SlabPlan& plan, const std::string& request) {
  Json slabs = Json::array();
  for (const Slab& s : plan.slabs) slabs.push_back({{"begin", s.begin}, {"end", s.end}, {"vertices", s.vertices}});
  return {{"pdc_plan", kPlanVersion},
          {"request", request},
          {"origin", {plan.origin.x, plan.origin.y, plan.origin.z}},
          {"step", plan.step},
          {"slabs", slabs}};
}

SlabPlan planFrom(const Json& json) {
  SlabPlan plan;
  for (int axis = 0; axis < 3; ++axis) plan.origin[axis] = json.at("origin").at(axis).get<double>();
  plan.step = json.at("step").get<double>();
  for (const Json& s : json.at("slabs"))
    plan.slabs.push_back({s.at("begin").get<int>(), s.at("end").get<int>(), s.at("vertices").get<std::uint64_t>()});
  return plan;
}

}  // namespace

SlabFolder SlabFolder::create(const fs::path& folder, const SlabPlan& plan, const std::string& request) {
  if (plan.slabs.size() >= kMostSlabs)
    throw Error(fmt::format("a plan of {} slabs; at most {}", plan.slabs.size(), kMostSlabs - 1));
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw detail::fileError(folder, "cannot be made", error.value());
  if (fs::exists(folder / kPlanName)) throw detail::fileError(folder, "holds a plan already");
  const std::string text = toJson(plan, request).dump(2) + "\n";
  detail::AtomicFile file(folder / kPlanName);
  file.write(text.data(), text.size());
  file.commit();
  return SlabFolder(folder);
}

SlabFolder::SlabFolder(fs::path folder) : mFolder(std::move(folder)) {
  const fs::path path = mFolder / kPlanName;
  if (!fs::exists(path)) throw detail::fileError(mFolder, "holds no plan");
  try {
    const Buffer<char> text = detail::readFile(path);
    const Json json = Json::parse(text.begin(), text.end());
    if (json.at("pdc_plan").get<int>() != kPlanVersion) throw Error("is of another version of pdc");
    mPlan = planFrom(json);
    mRequest = json.at("request").get<std::string>();
    mHash = detail::hashText(detail::hashOf(std::span<const char>(text.data(), text.size())));
  } catch (const Error& error) {
    throw detail::fileError(path, error.what());
  } catch (const std::exception&) {
    throw detail::fileError(path, "is damaged");
  }
}

fs::path SlabFolder::slabFile(std::size_t slab) const { return mFolder / fmt::format("slab_{:05}.pdcslab", slab); }

fs::path SlabFolder::lockFile(std::size_t slab) const { return mFolder / fmt::format("slab_{:05}.lock", slab); }

}  // namespace pdc
