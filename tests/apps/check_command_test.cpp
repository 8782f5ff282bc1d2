#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/program.h"

namespace pdc::test {
namespace {

using Json = nlohmann::json;

// A tetrahedron whose faces point outwards.
const std::string kTetrahedron = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
// Another one, upside down and pushed through the sloping face of the first.
const std::string kPiercing = "v 1 1 1\nv 9 9 9\nv 9 9 10\nv 9 10 9\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";

/// One call of `pdc check`, and what it said.
struct Checked {
  int exitCode;
  Json facts;
};

Checked check(const std::string& file, const Arguments& options = {}) {
  Arguments arguments{"check", file, "--json", "-"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = runPdc(arguments);
  EXPECT_EQ(outcome.err, "");
  return {outcome.exitCode, Json::parse(outcome.out)};
}

TEST(CheckCommand, CleanMesh) {
  const TemporaryFolder folder;
  const std::string file = folder.write("tetrahedron.obj", kTetrahedron + "v 7 7 7\n");
  const Checked checked = check(file);
  EXPECT_EQ(checked.exitCode, 0);
  EXPECT_EQ(checked.facts["clean"], true);
  EXPECT_EQ(checked.facts["faults"], Json::array());
  EXPECT_EQ(checked.facts["kind"], "mesh");
  EXPECT_EQ(checked.facts["euler_number"], 2);
  EXPECT_EQ(checked.facts["components"], 1);
  EXPECT_EQ(checked.facts["unused_vertices"], 1) << "which is no fault";
  EXPECT_NEAR(checked.facts["volume"], 64.0 / 6.0, 1e-12);

  const Outcome text = runPdc({"check", file});
  EXPECT_EQ(text.exitCode, 0);
  EXPECT_NE(text.out.find("\nself intersections              0\n"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.substr(text.out.size() - 7), "\nclean\n");
}

TEST(CheckCommand, EachFaultIsFound) {
  const TemporaryFolder folder;
  const auto faultsOf = [&](const std::string& mesh) {
    const Checked checked = check(folder.write("mesh.obj", mesh));
    EXPECT_EQ(checked.exitCode, 1);
    EXPECT_EQ(checked.facts["clean"], false);
    return checked.facts["faults"];
  };
  EXPECT_EQ(faultsOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), (Json{"boundary_edges"}));
  EXPECT_EQ(faultsOf(kTetrahedron + kPiercing), (Json{"self_intersections"}));
  EXPECT_EQ(faultsOf("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"), (Json{"inside_out"}));
  // A vertex in the middle of an edge; the faces on its two sides touch there, past the face without area.
  EXPECT_EQ(
      faultsOf("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nv 2 0 0\nf 1 3 5\nf 5 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 5 2\n"),
      (Json{"zero_area_triangles", "self_intersections"}));
  EXPECT_EQ(faultsOf(kTetrahedron + "f 1 3 2\n"),
            (Json{"non_manifold_edges", "non_manifold_vertices", "duplicate_faces", "self_intersections"}));
  EXPECT_EQ(faultsOf("v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n"),
            (Json{"misoriented_edges"}));
}

TEST(CheckCommand, OpenMeshesMayBeAllowed) {
  const TemporaryFolder folder;
  const std::string open = folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(check(open).exitCode, 1);
  EXPECT_EQ(check(open, {"--allow-boundary"}).exitCode, 0);
  const std::string folded = folder.write("folded.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 1 1 0\nf 1 2 3\nf 2 1 4\n");
  EXPECT_EQ(check(folded, {"--allow-boundary"}).facts["faults"], (Json{"self_intersections"}));
}

TEST(CheckCommand, AMeshWithoutFacesIsNotClean) {
  const TemporaryFolder folder;
  for (const std::string content : {"# nothing\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"}) {
    const std::string file = folder.write("empty.obj", content);
    const Checked checked = check(file);
    EXPECT_EQ(checked.exitCode, 1);
    EXPECT_EQ(checked.facts["no_faces"], true);
    EXPECT_EQ(checked.facts["faults"], (Json{"no_faces"}));
    EXPECT_EQ(check(file, {"--allow-empty"}).exitCode, 0);
    const Outcome text = runPdc({"check", file});
    EXPECT_NE(text.out.find("\nnot clean: no faces\n"), std::string::npos) << text.out;
  }
}

TEST(CheckCommand, WhatIsNoMeshIsNeverClean) {
  const TemporaryFolder folder;
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl"})
    for (const char* command : {"check", "info"})
      expectOneLineRefusal(
          runPdc({command, folder.write(name, "<!DOCTYPE html><html><body>404: Not Found</body></html>")}), 1,
          {name, "it seems to be an HTML page"});
}

TEST(CheckCommand, WarningsOfTheReaderAreShownAndReported) {
  const TemporaryFolder folder;
  const std::string file = folder.write("tetrahedron.stl", kTetrahedron);
  const std::string warning = file + ": an STL file by its suffix, but an OBJ file by its content, and read as that";
  const Outcome outcome = runPdc({"check", file, "--json", "-"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.err, "pdc: warning: " + warning + "\n");
  EXPECT_EQ(Json::parse(outcome.out)["warnings"], (Json{warning}));
  EXPECT_EQ(runPdc({"check", file, "--quiet"}).err, "");
  const Outcome text = runPdc({"check", file});
  EXPECT_EQ(text.out.find("warning"), std::string::npos) << text.out;
}

TEST(CheckCommand, VerdictSaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("pierced.obj", kTetrahedron + kPiercing + "v 0 0 20\nv 1 0 20\nv 0 1 20\nf 9 10 11\n");
  const Outcome outcome = runPdc({"check", file});
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("\nnot clean: 3 boundary edges, 3 self intersections\n"), std::string::npos)
      << outcome.out;
  const Outcome quiet = runPdc({"check", file, "--quiet"});
  EXPECT_EQ(quiet.exitCode, 1);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(CheckCommand, SaysWhenThereAreTooManyToCount) {
  const TemporaryFolder folder;
  std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 1500; ++i) mesh += "f 1 2 3\n";
  const std::string file = folder.write("often.obj", mesh);
  EXPECT_EQ(check(file).facts["all_self_intersections_counted"], false);
  const Outcome outcome = runPdc({"check", file});
  EXPECT_NE(outcome.out.find("more than 1000000 self intersections"), std::string::npos) << outcome.out;
}

TEST(CheckCommand, DoesNotDependOnThreads) {
  const TemporaryFolder folder;
  const std::string mesh = folder / "bullet.ply";
  EXPECT_EQ(runPdc({"mesh", bulletGrid(), mesh, "--placement", "free", "--quiet"}).exitCode, 0);
  const Checked all = check(mesh);
  for (const char* threads : {"1", "2", "8"}) EXPECT_EQ(check(mesh, {"--threads", threads}).facts, all.facts);
}

TEST(CheckCommand, JsonFileIsWhatStandardOutputWouldShow) {
  const TemporaryFolder folder;
  const std::string file = folder.write("tetrahedron.obj", kTetrahedron), report = folder / "report.json";
  const Outcome outcome = runPdc({"check", file, "--json", report});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(readFile(report), runPdc({"check", file, "--json", "-"}).out);
}

TEST(CheckCommand, BadFilesFailInOneLine) {
  const TemporaryFolder folder;
  const std::array<std::string, 4> files = {folder / "none.ply", folder.write("empty.ply", ""), bulletGrid(),
                                            folder.write("scene.yaml", "name: x\n")};
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const Outcome outcome = runPdc({"check", file});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.rfind("pdc: ", 0), 0u);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(runPdc({"check"}).exitCode, 2);
  EXPECT_EQ(runPdc({"check", files[0], "--threads", "-1"}).exitCode, 2);
}

}  // namespace
}  // namespace pdc::test
