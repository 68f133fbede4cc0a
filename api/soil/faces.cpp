#include "api/soil/faces.h"

#include <tuple>
#include <type_traits>

namespace snapthrough::api::soil {

namespace {

/// Parameters of a type that are linear between the faces.
template <class Type>
inline constexpr auto kVarying = std::tuple{};
template <>
inline constexpr auto kVarying<SoftClayMatlock> = std::tuple{&SoftClayMatlock::Su};
template <>
inline constexpr auto kVarying<StiffClayFreeWater> =
    std::tuple{&StiffClayFreeWater::Su, &StiffClayFreeWater::k};
template <>
inline constexpr auto kVarying<StiffClay> = std::tuple{&StiffClay::Su};
template <>
inline constexpr auto kVarying<ReeseSand> = std::tuple{&ReeseSand::k};
template <>
inline constexpr auto kVarying<PisaClay> = std::tuple{&PisaClay::Su, &PisaClay::G0};
template <>
inline constexpr auto kVarying<PisaSand> = std::tuple{&PisaSand::G0};
template <>
inline constexpr auto kVarying<WeakRock> = std::tuple{&WeakRock::q_u, &WeakRock::E_ir};
template <>
inline constexpr auto kVarying<ApiTzClay> = std::tuple{&ApiTzClay::friction};
template <>
inline constexpr auto kVarying<ApiTzSand> = std::tuple{&ApiTzSand::friction};

double between(double top, double bottom, double fraction) { return top + fraction * (bottom - top); }

template <class Variant>
Variant type_at(const Faces<Variant>& faces, double fraction) {
  return std::visit(
      [&](const auto& top) -> Variant {
        using Type = std::decay_t<decltype(top)>;
        const Type& bottom = std::get<Type>(faces.bottom);
        Type out = top;
        std::apply(
            [&](const auto... member) {
              ((out.*member = between(top.*member, bottom.*member, fraction)), ...);
            },
            kVarying<Type>);
        return out;
      },
      faces.top);
}

/// Returns parameters between fractions of the thickness. Faces that are kept keep their numbers.
template <class Variant>
Faces<Variant> part_of(const Faces<Variant>& faces, double from, double to) {
  return {from > 0.0 ? type_at(faces, from) : faces.top, to < 1.0 ? type_at(faces, to) : faces.bottom};
}

Sand part_of(const Sand& sand, double /*from*/, double /*to*/) { return sand; }
SoftClay part_of(const SoftClay& clay, double from, double to) {
  SoftClay part = clay;
  part.Su_top = from > 0.0 ? between(clay.Su_top, clay.Su_bottom, from) : clay.Su_top;
  part.Su_bottom = to < 1.0 ? between(clay.Su_top, clay.Su_bottom, to) : clay.Su_bottom;
  return part;
}

std::optional<double> strength_of(const Sand& /*sand*/, double /*fraction*/) { return std::nullopt; }
std::optional<double> strength_of(const SoftClay& clay, double fraction) {
  return between(clay.Su_top, clay.Su_bottom, fraction);
}
std::optional<double> strength_of(const Faces<LayerType>& faces, double fraction) {
  return std::visit(
      [](const auto& type) -> std::optional<double> {
        if constexpr (requires { type.Su; }) {
          return type.Su;
        } else {
          return std::nullopt;
        }
      },
      at(faces, fraction));
}

}  // namespace

LayerType at(const Faces<LayerType>& faces, double fraction) { return type_at(faces, fraction); }
AxialType at(const Faces<AxialType>& faces, double fraction) { return type_at(faces, fraction); }

Layer part_of(const Layer& layer, double from, double to) {
  Layer part = layer;
  part.soil = std::visit([&](const auto& soil) -> decltype(part.soil) { return part_of(soil, from, to); },
                         layer.soil);
  if (layer.axial) {
    part.axial->type = part_of(layer.axial->type, from, to);
  }
  return part;
}

std::optional<double> strength_at(const Layer& layer, double fraction) {
  return std::visit([&](const auto& soil) { return strength_of(soil, fraction); }, layer.soil);
}

LayerType with_mean_strength(LayerType type, double mean) {
  std::visit(
      [mean](auto& one) {
        if constexpr (requires { one.Su_mean; }) {
          one.Su_mean = mean;
        }
      },
      type);
  return type;
}

}  // namespace snapthrough::api::soil
