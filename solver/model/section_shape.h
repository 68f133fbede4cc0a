#pragma once
/// @file
/// Area, second moment and shear area of cross sections.

namespace snapthrough {

/// Geometry of a cross section in bending in its plane of symmetry.
struct SectionGeometry {
  double area = 0.0;
  double second_moment = 0.0;  ///< about the centroidal axis across the plane
  /// Area times Cowper's coefficient for Poisson's ratio 0 (J. Appl. Mech. 33, 1966): 5/6 for a rectangle.
  double shear_area = 0.0;
  double depth = 0.0;  ///< in the plane of bending; the centroidal axis is in the middle
};

/// Section of a web and two equal flanges, bent about its strong axis: an I section, or a channel that bends
/// in the plane of its web.
struct FlangedSection {
  double depth = 0.0;
  double width = 0.0;        ///< width of a flange
  double web = 0.0;          ///< thickness of the web
  double flange = 0.0;       ///< thickness of the flanges, of tapered ones at `flange_at`
  double root_radius = 0.0;  ///< radius of the fillets between web and flanges
  bool channel = false;      ///< the flanges lie on one side of the web
  double slope = 0.0;        ///< slope of the inner faces of tapered flanges, which are thinner at the tip
  double flange_at = 0.0;    ///< distance from the tip at which the thickness of a tapered flange is given
  double toe_radius = 0.0;   ///< radius of the inner edges at the tips
};

[[nodiscard]] SectionGeometry rectangle(double width, double depth);
/// Circular tube. @pre thickness <= diameter / 2; equal for a solid bar
[[nodiscard]] SectionGeometry tube(double diameter, double thickness);
/// Section with flanges; area and second moment contain fillets and rounded edges, the shear area is that of
/// thin walls without them, whose flanges have the thickness `flange`.
[[nodiscard]] SectionGeometry flanged_section(const FlangedSection& section);
/// Section with all lengths multiplied by a factor, such as that of another unit of length.
[[nodiscard]] FlangedSection scaled(const FlangedSection& section, double factor);

}  // namespace snapthrough
