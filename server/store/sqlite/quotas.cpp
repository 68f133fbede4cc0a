#include "server/store/sqlite/quotas.h"

namespace snapthrough::server::sqlite {

Status check_quotas(const Connection& connection, std::string_view owner, const Quotas& quotas,
                    const Usage& addition) {
  if (!quotas.any()) {
    return {};
  }
  Statement row =
      connection.prepare("SELECT jobs_waiting, points_waiting, bytes_kept FROM owners WHERE owner = ?");
  row.bind(owner);
  const Usage has = row.step() ? Usage{row.integer(0), row.integer(1), row.integer(2)} : Usage{};
  return server::check_quotas(quotas, has, addition);
}

}  // namespace snapthrough::server::sqlite
