// Files of meshes, and what is refused in them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "hulls.hpp"

namespace hydro::hydrostatics::mesh_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::string ascii_stl(const TriangleMesh& mesh) {
  std::string text = "solid hull of mine\n";
  for (const auto& t : mesh.triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const int v : t) {
      const auto& p = mesh.vertices[static_cast<std::size_t>(v)];
      text += fmt::format("  vertex {:.9e} {:.9e} {:.9e}\n", p.x(), p.y(), p.z());
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid hull of mine\n";
}

std::string binary_stl(const TriangleMesh& mesh) {
  std::string bytes(84, ' ');
  bytes.replace(0, 5, "solid");  // as some programs begin binary files
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::memcpy(bytes.data() + 80, &count, 4);
  for (const auto& t : mesh.triangles) {
    std::array<float, 12> record{};
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < 3; ++i)
        record[3 + 3 * c + i] =
            static_cast<float>(mesh.vertices[static_cast<std::size_t>(t[c])][static_cast<Eigen::Index>(i)]);
    bytes.append(reinterpret_cast<const char*>(record.data()), 48);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string obj(const TriangleMesh& mesh) {
  std::string text = "# made here\no hull\n";
  for (const auto& p : mesh.vertices) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : mesh.triangles) text += fmt::format("f {}/1/2 {}//3 {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

/// A quarter (x > 0, y > 0) of a box 4 m × 2 m of 1 m draught, open at the water: bottom, bow and port side.
const std::string quarter_box =
    "quarter of a box\n 1.0 9.80665 ULEN GRAV\n 1 1 ISX ISY\n3\n"
    "0 0 -1  0 1 -1  2 1 -1  2 0 -1\n"
    "2 0 -1  2 1 -1\n 2 1 0  2 0 0\n"
    "2 1 -1  0 1 -1  0 1 0  2 1 0\n";

TEST(MeshFiles, OfThreeFormatsGiveOneHull) {
  const TriangleMesh mesh = cylinder_mesh({0.25, -0.5}, 1.5, -2, 1, 24);
  const Immersion expected = immersion(Hull(mesh), {});
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"a.stl", ascii_stl(mesh)},
                                    {"b.STL", binary_stl(mesh)},
                                    {"c.obj", obj(mesh)}}) {
    const Hull hull(parse_mesh(bytes, name));
    EXPECT_TRUE(hull.closed()) << name;
    EXPECT_EQ(hull.vertices().size(), mesh.vertices.size()) << name;
    // 32-bit numbers hold 6e-8 of the coordinates.
    EXPECT_NEAR(immersion(hull, {}).volume, expected.volume, 1e-6 * expected.volume) << name;
  }
}

TEST(MeshFiles, OfOneQuarterInGdfGiveTheWholeHull) {
  const Hull hull(parse_mesh(quarter_box, "box.gdf"));
  EXPECT_FALSE(hull.closed());
  EXPECT_EQ(hull.parts(), 1);
  const Immersion im = immersion(hull, {});
  EXPECT_NEAR(im.volume, 8, 1e-13);
  EXPECT_NEAR(im.waterplane->area, 8, 1e-13);
  EXPECT_NEAR(im.waterplane->second_moment(1, 1), 4 * 8 / 12.0, 1e-13);
  EXPECT_NEAR(im.centre_of_buoyancy->z(), -0.5, 1e-14);
  EXPECT_NEAR(im.wetted_area, 8 + 12, 1e-13);
}

TEST(MeshFiles, InGdfAreNotScaledByUlenAndAreInTheUnitOfGrav) {
  std::string ulen = quarter_box, feet = quarter_box;
  ulen.replace(ulen.find("1.0 9.8"), 3, "7.5");
  EXPECT_NEAR(Hull(parse_mesh(ulen, "box.gdf")).volume(), 8, 1e-13);
  feet.replace(feet.find("9.80665"), 7, "32.174");
  EXPECT_THAT(
      [&] { parse_mesh(feet, "box.gdf"); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("box.gdf:2"), HasSubstr("GRAV = 32.174"), HasSubstr("unit ft"))));
  EXPECT_NEAR(Hull(parse_mesh(feet, "box.gdf", {.unit = 0.3048, .reverse = false, .weld = 1e-6})).volume(),
              8 * std::pow(0.3048, 3), 1e-13);
}

TEST(MeshFiles, WithoutADeckGetOneWithAFreeboard) {
  const Hull hull(with_freeboard(parse_mesh(quarter_box, "box.gdf"), 0.75));
  EXPECT_TRUE(hull.closed());
  EXPECT_NEAR(hull.volume(), 8 * 1.75, 1e-13);
  EXPECT_NEAR(hull.area(), 2 * 8 + 12 * 1.75, 1e-13);
  const Pose heeled{attitude_of(Angle::from_degrees(20), Angle::from_degrees(3)), {0, 0, 0}};
  const Hull box(box_mesh({-2, -1, -1}, {2, 1, 0.75}));
  EXPECT_NEAR(immersion(hull, heeled).volume, immersion(box, heeled).volume, 1e-13);
  EXPECT_THAT(
      [] {
        with_freeboard(box_mesh({0, 0, 0}, {1, 1, 1}), 1);
      },
      ThrowsMessage<InputError>(HasSubstr("closed")));
}

TEST(MeshFiles, InMillimetresAreFoundOutOrConverted) {
  TriangleMesh big = box_mesh({-5000, -2000, -1000}, {5000, 2000, 2000});
  const std::string text = obj(big);
  EXPECT_THAT([&] { Hull(parse_mesh(text, "a.obj")); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("5 km"), HasSubstr("unit mm"))));
  EXPECT_NEAR(Hull(parse_mesh(text, "a.obj", {.unit = 1e-3, .reverse = false, .weld = 1e-6})).volume(), 120, 1e-12);
}

TEST(MeshFiles, InsideOutAreRefusedOrReversed) {
  TriangleMesh box = box_mesh({-1, -1, -1}, {1, 1, 1});
  for (auto& t : box.triangles) std::swap(t[0], t[1]);
  EXPECT_THAT([&] { Hull{box}; }, ThrowsMessage<InputError>(AllOf(HasSubstr("inside out"), HasSubstr("-8 m³"))));
  EXPECT_NEAR(Hull(parse_mesh(obj(box), "a.obj", {.unit = {}, .reverse = true, .weld = 1e-6})).volume(), 8, 1e-14);
  EXPECT_THAT(
      [&] {
        Hull(joined({box_mesh({3, 3, 3}, {4, 4, 9}), box}));
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("of 2 parts"), HasSubstr("inside out"))));
}

TEST(MeshFiles, WithOneFaceTurnedRoundOrDoubledAreRefused) {
  TriangleMesh turned = box_mesh({-1, -1, -1}, {1, 1, 1}), doubled = turned;
  std::swap(turned.triangles[4][0], turned.triangles[4][1]);
  EXPECT_THAT([&] { Hull{turned}; }, ThrowsMessage<InputError>(HasSubstr("do not agree on what is outside")));
  doubled.triangles.push_back(doubled.triangles[4]);
  EXPECT_THAT([&] { Hull{doubled}; }, ThrowsMessage<InputError>(HasSubstr("3 triangles meet at the edge")));
}

// All edges of a mesh that is there twice agree, but it would displace its water twice.
TEST(MeshFiles, WithAllFacesTwiceAreRefused) {
  TriangleMesh box = box_mesh({-1, -1, -1}, {1, 1, 1});
  const auto once = box.triangles;
  for (const auto& t : once) box.triangles.push_back({t[1], t[2], t[0]});  // the same, from another corner on
  EXPECT_THAT([&] { Hull{box}; }, ThrowsMessage<InputError>(HasSubstr("a face is there twice")));
}

TEST(MeshFiles, MayHoldSliversAndLoseCollapsedTriangles) {
  // A vertex in the middle of an edge of one face only; a sliver joins it to the other face.
  TriangleMesh box = box_mesh({-1, -1, -1}, {1, 1, 1});
  box.vertices.emplace_back(0, -1, -1);  // 8, on the edge 0-1
  auto& faces = box.triangles;
  const auto shared = std::find_if(faces.begin(), faces.end(), [](const auto& t) {
    for (std::size_t c = 0; c < 3; ++c)
      if (t[c] == 0 && t[(c + 1) % 3] == 1) return true;
    return false;
  });
  ASSERT_NE(shared, faces.end());
  const int third = (*shared)[0] + (*shared)[1] + (*shared)[2] - 1;
  *shared = {0, 8, third};
  faces.push_back({8, 1, third});
  EXPECT_FALSE(Hull(box).closed());
  faces.push_back({0, 1, 8});
  const Hull hull(box);
  EXPECT_TRUE(hull.closed());
  EXPECT_EQ(hull.slivers(), 1);
  EXPECT_NEAR(immersion(hull, {}).volume, 4, 1e-14);
  faces.push_back({2, 2, 3});
  const TriangleMesh clean = welded(box, 1e-9);
  EXPECT_EQ(clean.triangles.size(), faces.size() - 1);
  ASSERT_EQ(clean.notes.size(), 1U);
  EXPECT_THAT(clean.notes[0], HasSubstr("left out"));
}

struct BadFile {
  std::string name, text, told;
};

TEST(MeshFiles, ThatAreWrongAreRefusedWithLineAndReason) {
  const std::string stl = ascii_stl(box_mesh({-1, -1, -1}, {1, 1, 1})),
                    binary = binary_stl(box_mesh({-1, -1, -1}, {1, 1, 1}));
  const auto with = [](std::string text, const std::string& old, const std::string& now) {
    return text.replace(text.find(old), old.size(), now);
  };
  const std::vector<BadFile> files{
      {"a.stl", stl.substr(0, stl.find("outer") + 5), "cut short"},
      {"a.stl", stl.substr(0, stl.size() / 2), "\"endfacet\" should be here"},
      {"a.stl", stl.substr(0, stl.rfind("endsolid")), "before endsolid"},
      {"a.stl", with(stl, "vertex", "vertices"), "a.stl:4"},
      {"a.stl", binary.substr(0, 300), "asks for 684 bytes, it has 300"},
      {"a.stl", "", "too few"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "a.obj:4"},
      {"a.obj", "v 0 0 0\nv 1 0 nan\n", "a.obj:2"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "2 corners"},
      {"a.obj", "v 0 0 0\nf 1 two 3\n", "\"two\" names no vertex"},
      {"a.obj", "v 0 0 0\ncurv 0 1 1 2\n", "\"curv\" is not read"},
      {"a.obj", "# nothing\n", "no faces"},
      {"a.gdf", quarter_box.substr(0, quarter_box.size() - 9), "panel 3 of 3"},
      {"a.gdf", with(quarter_box, "1 1 ISX", "2 1 ISX"), "0 or 1"},
      {"a.gdf", with(quarter_box, "1.0 9.8", "0.0 9.8"), "ULEN"},
      {"a.gdf", with(quarter_box, "\n3\n", "\n3 1\n"), "higher order"},
      {"a.gdf", "title", "line of title"},
      {"a.msh", "x", "meshes are .stl, .obj or .gdf"},
  };
  for (const auto& file : files)
    EXPECT_THAT([&] { parse_mesh(file.text, file.name); }, ThrowsMessage<InputError>(HasSubstr(file.told)))
        << file.name << ": " << file.told;
}

TEST(MeshFiles, ThatAreCutAnywhereNeverCrash) {
  const TriangleMesh box = box_mesh({-1, -1, -1}, {1, 1, 1});
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"a.stl", ascii_stl(box)},
                                    {"b.stl", binary_stl(box)},
                                    {"c.obj", obj(box)},
                                    {"d.gdf", quarter_box}})
    for (std::size_t size = 0; size < bytes.size(); size += 3) {
      try {
        Hull(parse_mesh(std::string_view(bytes).substr(0, size), name));  // a cut in an OBJ may leave a smaller hull
      } catch (const InputError&) {
      }
    }
}

TEST(Primitives, ComeNearerToTheTrueShapeWithTheSquareOfTheirEdges) {  // (H3)
  const double sphere = 4 * std::numbers::pi * 8 / 3;
  double before = 0;
  for (int cuts = 2; cuts <= 5; ++cuts) {
    const double lacks = sphere - Hull(sphere_mesh({1, 2, 3}, 2, cuts)).volume();
    EXPECT_GT(lacks, 0);
    if (cuts > 2) {
      EXPECT_NEAR(before / lacks, 4, 0.3) << cuts;  // 4 in the limit
    }
    before = lacks;
  }
}

TEST(Primitives, KnowWhatTheirChordsLack) {  // (H2)
  // To first order: the rest falls with the square of the edge as well.
  const Hull sphere(sphere_mesh({0, 0, 0}, 2, 4));
  const double lacks = 4 * std::numbers::pi * 8 / 3 - sphere.volume();
  EXPECT_NEAR(chord_volume(sphere), lacks, 0.03 * lacks);
  // A cylinder's knuckles are no chords; its walls are.
  const Hull cylinder(cylinder_mesh({0, 0}, 2, -3, 1, 48));
  const double short_by = std::numbers::pi * 4 * 4 - cylinder.volume();
  EXPECT_NEAR(chord_volume(cylinder), short_by, 0.01 * short_by);
  EXPECT_NEAR(chord_volume(Hull(box_mesh({0, 0, 0}, {1, 2, 3}))), 0, 1e-15);
}

}  // namespace
}  // namespace hydro::hydrostatics::mesh_test
