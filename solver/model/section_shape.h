#pragma once
/// @file
/// Area, second moment and shear area of cross sections.

#include <array>
#include <span>
#include <string_view>

namespace snapthrough {

/// Geometry of a cross section in bending in its plane of symmetry.
struct SectionGeometry {
  double area = 0.0;
  double second_moment = 0.0;  ///< about the centroidal axis across the plane
  /// Area times Cowper's coefficient for Poisson's ratio 0 (J. Appl. Mech. 33, 1966): 5/6 for a rectangle.
  double shear_area = 0.0;
};

/// Rolled or welded I section that is symmetric about both axes, bent about its strong axis.
struct ISection {
  double depth = 0.0;
  double width = 0.0;
  double web = 0.0;          ///< thickness of the web
  double flange = 0.0;       ///< thickness of the flanges
  double root_radius = 0.0;  ///< radius of the four fillets between web and flanges
};

/// I section of EN 10365:2017, dimensions in millimetres.
struct Profile {
  std::string_view name;  ///< such as "IPE 300", "HEB 200"
  ISection section;
};

[[nodiscard]] SectionGeometry rectangle(double width, double depth);
/// Circular tube. @pre thickness <= diameter / 2; equal for a solid bar
[[nodiscard]] SectionGeometry tube(double diameter, double thickness);
/// I section; area and second moment contain the fillets, the shear area is that of thin walls without them.
[[nodiscard]] SectionGeometry i_section(const ISection& section);
/// I section with all dimensions multiplied by a factor, such as that of another unit of length.
[[nodiscard]] ISection scaled(const ISection& section, double factor);

/// Profiles of the series IPE, HEA, HEB and HEM.
[[nodiscard]] std::span<const Profile> profiles();

}  // namespace snapthrough
