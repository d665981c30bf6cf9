// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/kinds.hpp"

namespace kappa {

const std::vector<Named<SurfaceKind>>& names_of(SurfaceKind) {
  static const std::vector<Named<SurfaceKind>> names = {
      {SurfaceKind::Auto, "auto", "the faces of the file; without any, grid, spinning or umbrella by what the scan is"},
      {SurfaceKind::Faces, "faces", "the faces of the file"},
      {SurfaceKind::Umbrella, "umbrella", "a star of triangles around every point"},
      {SurfaceKind::Grid, "grid", "the cells of a cloud that is organised in rows"},
      {SurfaceKind::Delaunay, "delaunay", "a triangulation in plan, with one height at each place"},
      {SurfaceKind::Spinning, "spinning", "the cells of a sweep of a spinning scanner"},
      {SurfaceKind::Greedy, "greedy", "PCL's greedy projection, for comparison"},
      {SurfaceKind::Uniform, "uniform", "no faces: for each point, triangles of three random neighbours"},
      {SurfaceKind::Independent, "independent", "no faces: for each point, random triangles that share no corner"},
      {SurfaceKind::Hexagram, "hexagram",
       "no faces: for each point, two triangles of the neighbours nearest to a hexagram"},
      {SurfaceKind::AveragedHexagram, "avg-hexagram",
       "no faces: for each point, two triangles of the averages of the neighbours in six sectors"},
  };
  return names;
}

std::optional<TriangleScheme> triangle_scheme(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Uniform:
      return TriangleScheme::Uniform;
    case SurfaceKind::Independent:
      return TriangleScheme::Independent;
    case SurfaceKind::Hexagram:
      return TriangleScheme::Hexagram;
    case SurfaceKind::AveragedHexagram:
      return TriangleScheme::AveragedHexagram;
    default:
      return std::nullopt;
  }
}

bool has_turned_faces(SurfaceKind kind) {
  return kind == SurfaceKind::Faces || kind == SurfaceKind::Grid || kind == SurfaceKind::Delaunay ||
         kind == SurfaceKind::Spinning;
}

const std::vector<Named<NormalsKind>>& names_of(NormalsKind) {
  static const std::vector<Named<NormalsKind>> names = {
      {NormalsKind::Auto, "auto", "those of the file; without any, from the faces or fitted to the points"},
      {NormalsKind::Input, "input", "the normals of the file"},
      {NormalsKind::Geometric, "geometric", "from the faces around a point, each with the same weight"},
      {NormalsKind::Area, "area", "from the faces around a point, weighted by their areas"},
      {NormalsKind::Angle, "angle", "from the faces around a point, weighted by their angles there"},
      {NormalsKind::Max, "max", "from the faces around a point, by Max's weights, which are exact on spheres"},
      {NormalsKind::Pca, "pca", "planes fitted to the points"},
      {NormalsKind::Quadric, "quadric", "quadrics fitted to the points"},
      {NormalsKind::Robust, "robust", "planes and quadrics fitted to the points, which resist edges and outliers"},
  };
  return names;
}

bool from_faces(NormalsKind kind) {
  return kind == NormalsKind::Geometric || kind == NormalsKind::Area || kind == NormalsKind::Angle ||
         kind == NormalsKind::Max;
}

const std::vector<Named<Orientation>>& names_of(Orientation) {
  static const std::vector<Named<Orientation>> names = {
      {Orientation::Auto, "auto", "by what is known of the scan"},
      {Orientation::Input, "input", "as the normals of the file are"},
      {Orientation::AsFaces, "faces", "the side from which the faces turn counter-clockwise"},
      {Orientation::Up, "up", "z is not negative"},
      {Orientation::Viewpoint, "viewpoint", "towards the scanner"},
      {Orientation::Consistent, "mst", "neighbours alike, closed parts outward"},
      {Orientation::Consistent, "outward", "another word for mst"},
  };
  return names;
}

}  // namespace kappa
