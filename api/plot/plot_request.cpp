#include "api/plot/plot_request.h"

namespace snapthrough::api {

bool add_condition(std::string_view text, PlotRequest& request) {
  const std::size_t equals = text.find('=');
  return equals != std::string_view::npos &&
         request.where.emplace(text.substr(0, equals), text.substr(equals + 1)).second;
}

}  // namespace snapthrough::api
