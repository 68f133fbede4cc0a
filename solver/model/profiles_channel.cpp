/// @file
/// Channels of the series UPE and UPN: depth, width, web, flange, root radius in millimetres.
/// Source: EN 10365:2017, nominal dimensions.

#include "solver/model/profile_tables.h"

namespace snapthrough {
namespace {

// clang-format off
constexpr Profile kUpe[] = {
    {"UPE 80", {80, 50, 4, 7, 10}},
    {"UPE 100", {100, 55, 4.5, 7.5, 10}},
    {"UPE 120", {120, 60, 5, 8, 12}},
    {"UPE 140", {140, 65, 5, 9, 12}},
    {"UPE 160", {160, 70, 5.5, 9.5, 12}},
    {"UPE 180", {180, 75, 5.5, 10.5, 12}},
    {"UPE 200", {200, 80, 6, 11, 13}},
    {"UPE 220", {220, 85, 6.5, 12, 13}},
    {"UPE 240", {240, 90, 7, 12.5, 15}},
    {"UPE 270", {270, 95, 7.5, 13.5, 15}},
    {"UPE 300", {300, 100, 9.5, 15, 15}},
    {"UPE 330", {330, 105, 11, 16, 18}},
    {"UPE 360", {360, 110, 12, 17, 18}},
    {"UPE 400", {400, 115, 13.5, 18, 18}},
};

constexpr Profile kUpn[] = {
    {"UPN 50", {50, 38, 5, 7, 7}},
    {"UPN 65", {65, 42, 5.5, 7.5, 7.5}},
    {"UPN 80", {80, 45, 6, 8, 8}},
    {"UPN 100", {100, 50, 6, 8.5, 8.5}},
    {"UPN 120", {120, 55, 7, 9, 9}},
    {"UPN 140", {140, 60, 7, 10, 10}},
    {"UPN 160", {160, 65, 7.5, 10.5, 10.5}},
    {"UPN 180", {180, 70, 8, 11, 11}},
    {"UPN 200", {200, 75, 8.5, 11.5, 11.5}},
    {"UPN 220", {220, 80, 9, 12.5, 12.5}},
    {"UPN 240", {240, 85, 9.5, 13, 13}},
    {"UPN 260", {260, 90, 10, 14, 14}},
    {"UPN 280", {280, 95, 10, 15, 15}},
    {"UPN 300", {300, 100, 10, 16, 16}},
    {"UPN 320", {320, 100, 14, 17.5, 17.5}},
    {"UPN 350", {350, 100, 14, 16, 16}},
    {"UPN 380", {380, 102, 13.5, 16, 16}},
    {"UPN 400", {400, 110, 14, 18, 18}},
};
// clang-format on

}  // namespace

std::span<const Profile> upe_profiles() { return kUpe; }
std::span<const Profile> upn_profiles() { return kUpn; }

}  // namespace snapthrough
