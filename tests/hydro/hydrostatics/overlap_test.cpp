// Meshes that cover a volume twice are refused, and shells that only touch are not. (H1)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hulls.hpp"

namespace hydro::hydrostatics::overlap_test {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A box of squares of 1 m, whose lines fall on those of other such boxes.
TriangleMesh gridded_box(const Vector3d& low, const Vector3d& high) {
  std::vector<TriangleMesh> faces;
  const auto add = [&](const Vector3d& from, const Vector3d& u, const Vector3d& v) {
    const Vector3d du = u.normalized(), dv = v.normalized();
    for (int i = 0; i < std::lround(u.norm()); ++i)
      for (int j = 0; j < std::lround(v.norm()); ++j) {
        const Vector3d at = from + i * du + j * dv;
        faces.push_back(
            {.source = "grid", .vertices = {at, at + du, at + du + dv, at + dv}, .triangles = {{0, 1, 2}, {0, 2, 3}}});
      }
  };
  const Vector3d x((high - low).x(), 0, 0), y(0, (high - low).y(), 0), z(0, 0, (high - low).z());
  add(low, y, x);
  add(low, z, y);
  add(low, x, z);
  add(low + z, x, y);
  add(low + x, y, z);
  add(low + y, z, x);
  return welded(joined(std::move(faces)), 1e-6);
}

void expect_refused(const TriangleMesh& mesh, const char* words) {
  EXPECT_THAT([&] { Hull{mesh}; }, ThrowsMessage<InputError>(HasSubstr(words)));
}

TEST(Overlap, OfAColumnPushedIntoItsPontoonIsRefused) {
  const TriangleMesh pontoon = gridded_box({-8, -4, -10}, {8, 4, -6});
  expect_refused(joined({pontoon, gridded_box({-2, -2, -8}, {2, 2, 3})}), "inside the hull");
  expect_refused(joined({pontoon, cylinder_mesh({0.3, 0.2}, 2, -8, 3, 12)}), "the mesh pierces itself at (");
}

TEST(Overlap, OfCrossedBoxesIsRefusedThoughNoCentreOfAFaceIsInside) {
  expect_refused(joined({box_mesh({-8, -1, -3}, {8, 1, 1}), box_mesh({-1, -8, -2}, {1, 8, 2})}), "cross");
}

TEST(Overlap, OfAShellInsideAnotherIsRefused) {
  expect_refused(joined({box_mesh({-8, -8, -8}, {8, 8, 2}), box_mesh({-1, -1, -3}, {1, 1, -1})}), "inside the hull");
}

TEST(Overlap, OfBoxesWhoseFacesLieInOnePlaneIsRefusedWeldedOrNot) {
  const TriangleMesh both = joined({gridded_box({-6, -2, -3}, {1, 2, 1}), gridded_box({-1, -2, -3}, {6, 2, 1})});
  expect_refused(both, "inside the hull");
  expect_refused(welded(both, 1e-6), "twice");
}

TEST(Overlap, OfAnOpenHullIsSeenThroughItsOpening) {
  TriangleMesh open = gridded_box({-8, -4, -4}, {8, 4, 0});
  std::erase_if(open.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](int v) { return open.vertices[static_cast<std::size_t>(v)].z() == 0; });
  });
  EXPECT_FALSE(Hull(open).closed());
  expect_refused(joined({open, box_mesh({-1.3, -1.2, -3}, {1.1, 1.4, -2})}), "inside the hull");
}

TEST(Overlap, IsNoneOfShellsThatTouchOrAlmostDo) {
  // On, in and out of each other by less than 1e-5 of 17 m: by what 32-bit numbers make of a place.
  for (const double gap : {0., 1e-4, -1e-4, 1e-9, -1e-9}) {
    const TriangleMesh both =
        joined({gridded_box({-8, -2, -4}, {0, 2, 1}), gridded_box({gap, -2, -4}, {8 + gap, 2, 1})});
    EXPECT_NEAR(Hull(both).volume(), 2 * 160, 1e-9 * 320) << gap;  // rounding of a sum over 700 triangles
    if (gap == 0) {
      EXPECT_NEAR(Hull(welded(both, 1e-6)).volume(), 2 * 160, 1e-9 * 320);
    }
  }
}

TEST(Overlap, IsNoneOfShellsBesideAndAboveOneAnother) {
  const Hull catamaran(joined(
      {cylinder_mesh({0, 5}, 2, -3, 1, 24), cylinder_mesh({0, -5}, 2, -3, 1, 24), sphere_mesh({0, 0, -8}, 3, 3)}));
  EXPECT_EQ(catamaran.parts(), 3);
}

}  // namespace
}  // namespace hydro::hydrostatics::overlap_test
