#include "alea/simulate/mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iomanip>

#include "alea/core/error.hpp"
#include "alea/simulate/primitive_ray.hpp"
#include "alea/simulate/scanner.hpp"
#include "alea/simulate/scene_file.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

const std::string unit_cube_off =
    "OFF # a cube\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
const std::string unit_cube_obj =
    "# a cube\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "vn 0 0 1\nf 1//1 4//1 3//1 2//1\nf 5/1/1 6/1/1 7/1/1 8/1/1\nf -8 -7 -3 -4\nf 2 3 7 6\n"
    "f 3 4 8 7\nf 4 1 5 8\n";
const std::string unit_cube_ply =
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
    "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

std::string binary_cube_ply() {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty double x\n"
      "property double y\nproperty double z\nelement face 6\nproperty uchar flags\n"
      "property list uchar uint vertex_index\nend_header\n";
  const auto put = [&text](const auto& value) {
    std::string bytes(sizeof(value), '\0');
    std::memcpy(bytes.data(), &value, sizeof(value));
    text += bytes;
  };
  for (const auto& v : {std::array<double, 3>{0, 0, 0},
                        {1, 0, 0},
                        {1, 1, 0},
                        {0, 1, 0},
                        {0, 0, 1},
                        {1, 0, 1},
                        {1, 1, 1},
                        {0, 1, 1}})
    put(v);
  for (const auto& f : {std::array<std::uint32_t, 4>{0, 3, 2, 1},
                        {4, 5, 6, 7},
                        {0, 1, 5, 4},
                        {1, 2, 6, 5},
                        {2, 3, 7, 6},
                        {3, 0, 4, 7}}) {
    put(std::uint8_t{9});
    put(std::uint8_t{4});
    put(f);
  }
  return text;
}

TriangleMesh read_text_as(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder.file(name), std::ios::binary) << text;
  return read_mesh(folder.file(name));
}

std::string error_of(const std::string& name, const std::string& text) {
  try {
    read_text_as(name, text);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    return error.what();
  }
  return "no error";
}

TEST(MeshFile, TheSameCubeInEveryFormat) {
  const TriangleMesh off = read_text_as("cube.off", unit_cube_off);
  ASSERT_EQ(off.vertices.size(), 8u);
  ASSERT_EQ(off.triangles.size(), 12u);
  for (const auto& [name, text] : {std::pair<std::string, std::string>("cube.obj", unit_cube_obj),
                                   {"cube.ply", unit_cube_ply},
                                   {"binary.PLY", binary_cube_ply()}}) {
    const TriangleMesh other = read_text_as(name, text);
    EXPECT_EQ(other.vertices, off.vertices) << name;
    EXPECT_EQ(other.triangles, off.triangles) << name;
  }
}

TEST(MeshFile, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_THAT(error_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
              AllOf(HasSubstr("a.off:6"), HasSubstr("names vertex 7")));
  EXPECT_THAT(error_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"), HasSubstr("ends before the last"));
  EXPECT_THAT(error_of("a.off", "OFF\n-3 1 0\n"), HasSubstr("counts"));
  EXPECT_THAT(error_of("a.off", "NOFF\n"), HasSubstr("begins with the word OFF"));
  EXPECT_THAT(error_of("a.obj", "v 0 0 0\nv 1 0\n"),
              AllOf(HasSubstr("a.obj:2"), HasSubstr("vertex")));
  EXPECT_THAT(error_of("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), HasSubstr("a face of 2 corners"));
  EXPECT_THAT(error_of("a.obj", "v 0 0 0\nf 1 2 -9\n"), HasSubstr("names vertex"));
  EXPECT_THAT(error_of("a.obj", "v 0 0 0\n"), HasSubstr("no faces"));
  EXPECT_THAT(error_of("a.stl", "solid\n"), HasSubstr("not a mesh file"));
  const std::string binary = binary_cube_ply();
  EXPECT_THAT(error_of("a.ply", binary.substr(0, binary.size() - 3)), HasSubstr("ends early"));
}

TEST(Mesh, RefusesWhatNoTreeCanHold) {
  EXPECT_THROW(build_mesh("empty", {}), Error);
  EXPECT_THROW(build_mesh("index", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 3}}}), Error);
  EXPECT_THROW(build_mesh("nan", {{{0, 0, 0}, {1, 0, NAN}, {0, 1, 0}}, {{0, 1, 2}}}), Error);
}

TEST(Mesh, IsSeenFromBothSidesAndBehindNearerThings) {
  const Mesh mesh =
      build_mesh("triangle", {{{1, -1, -1}, {1, 1, -1}, {1, 0, 1}}, {{0, 1, 2}}}, 0.7);
  for (const double side : {-1.0, 1.0}) {
    Hit hit;
    intersect(mesh, 4, {{1 + 2 * side, 0.1, 0}, {-side, 0, 0}}, hit);
    EXPECT_DOUBLE_EQ(hit.range_m, 2);
    EXPECT_EQ(hit.intensity, 0.7);
    EXPECT_EQ(hit.surface.kind, SurfaceKind::mesh);
    EXPECT_EQ(hit.surface.index, 4u);
  }
  Hit nearer;
  nearer.range_m = 1.5;
  intersect(mesh, 0, {{3, 0.1, 0}, {-1, 0, 0}}, nearer);
  EXPECT_EQ(nearer.range_m, 1.5);
  Hit away;
  intersect(mesh, 0, {{3, 0.1, 0}, {1, 0, 0}}, away);
  EXPECT_TRUE(std::isinf(away.range_m));
}

// The same scan of the same cube, once as a box and once as triangles out of a file.
TEST(Mesh, AScanOfACubeMeshIsThatOfTheBox) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("cube.off")) << unit_cube_off;
  const std::string rest =
      "omega_phi_kappa_deg = [0, 0, 20]\nintensity = 0.6\n"
      "[[station]]\nposition_m = [4, 0.3, 1.5]\naim_at = \"cube\"\nstep_mrad = 5\n";
  // A turn about z by 20 deg takes the centre (0.25, 0.25, 0.25) of the mesh's frame along.
  const double c = std::cos(20 * M_PI / 180), s = std::sin(20 * M_PI / 180);
  std::ofstream(folder.file("mesh.toml"))
      << "[[mesh]]\nid = \"cube\"\nfile = \"cube.off\"\nscale = 0.5\nposition_m = ["
      << std::setprecision(17) << -0.25 * (c - s) << ", " << -0.25 * (s + c) << ", 0]\n"
      << rest;
  std::ofstream(folder.file("box.toml"))
      << "[[box]]\nid = \"cube\"\nsize_m = [0.5, 0.5, 0.5]\ncentre_m = [0, 0, 0.25]\n"
      << rest;
  const auto scan = [&](const std::string& file) {
    const Scene scene = load_scene(folder.file(file));
    return simulate_scan(scene, scene.stations[0], {});
  };
  const Cloud of_mesh = scan("mesh.toml"), of_box = scan("box.toml");
  ASSERT_GT(of_box.size(), 500u);
  ASSERT_EQ(of_mesh.size(), of_box.size());
  for (std::size_t i = 0; i < of_box.size(); ++i)
    EXPECT_LT((of_mesh.positions[i] - of_box.positions[i]).norm(), 1e-6) << i;
}

TEST(Mesh, AnInlineMeshThatIsWrongNamesItsLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& mesh) -> std::string {
    std::ofstream(folder.file("scene.toml")) << "[[mesh]]\nposition_m = [0, 0, 0]\n" << mesh;
    try {
      load_scene(folder.file("scene.toml"));
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message("vertices_m = [[0,0,0],[1,0,0],[0,1,0]]\ntriangles = [[0, 1, 3]]\n"),
              AllOf(HasSubstr("scene.toml:4"), HasSubstr("counted from 0")));
  EXPECT_THAT(message("vertices_m = [[0,0]]\n"), HasSubstr("three finite numbers each"));
  EXPECT_THAT(message(""), HasSubstr("a file, or vertices_m and triangles"));
  EXPECT_THAT(message("file = \"none.obj\"\n"), HasSubstr("none.obj"));
}

}  // namespace
}  // namespace alea
