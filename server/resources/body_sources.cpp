#include "server/resources/body_sources.h"

#include <utility>

namespace snapthrough::server::http {
namespace {

class TableSource final : public BodySource {
 public:
  TableSource(SweepStore& store, const SweepRecord& sweep, api::TableWriter writer, const PointQuery& query)
      : store_(store), sweep_(sweep), writer_(std::move(writer)), unread_(query) {}

  StatusOr<bool> append_next(std::string& piece) override {
    if (!std::exchange(begun_, true)) {
      piece += writer_.head();
    }
    if (more_rows_) {
      if (Status status = append_rows(piece); !status.ok()) {
        return status;
      }
    }
    return more_rows_ || writer_.append_tail(piece, kPieceBytes);
  }
  [[nodiscard]] std::size_t held_bytes() const override { return writer_.held_bytes(); }

 private:
  Status append_rows(std::string& piece);
  [[nodiscard]] Status check_same() const;

  SweepStore& store_;
  const SweepRecord sweep_;
  api::TableWriter writer_;
  PointQuery unread_;
  bool begun_ = false;
  bool more_rows_ = true;
};

Status TableSource::append_rows(std::string& piece) {
  more_rows_ = false;
  std::uint64_t next = unread_.first;
  const Status status =
      store_.each_row(sweep_.id, unread_, [&](std::uint64_t point, const api::PointOutcome& outcome) {
        writer_.append_row(point, outcome, piece);
        next = point + 1;
        more_rows_ = piece.size() >= kPieceBytes;
        return !more_rows_;
      });
  unread_.count -= next - unread_.first;
  unread_.first = next;
  return status.ok() && !more_rows_ ? check_same() : status;
}

Status TableSource::check_same() const {
  const StatusOr<std::optional<SweepRecord>> now = store_.get(sweep_.id);
  if (!now.ok()) {
    return now.status();
  }
  if (!now->has_value()) {
    return {StatusCode::conflict, "the sweep was removed while its table was read"};
  }
  const bool was_complete = sweep_.done() == sweep_.points;
  if (was_complete && (*now)->finished != sweep_.finished) {
    return {StatusCode::conflict, "the sweep was tried again while its table was read"};
  }
  return {};
}

/// A result document, byte for byte as stored.
class ResultSource final : public BodySource {
 public:
  ResultSource(Store& store, std::string job) : store_(store), job_(std::move(job)) {}

  StatusOr<bool> append_next(std::string& piece) override {
    const StatusOr<DocumentPiece> read = store_.result_piece(job_, offset_, kPieceBytes);
    if (!read.ok()) {
      return read.status();
    }
    if (read->bytes.empty()) {
      return Status(StatusCode::conflict, "the job was removed while its result was read");
    }
    piece += read->bytes;
    offset_ += read->bytes.size();
    return offset_ < read->size;
  }
  [[nodiscard]] std::size_t held_bytes() const override { return job_.size(); }

 private:
  Store& store_;
  const std::string job_;
  std::size_t offset_ = 0;
};

/// A table of a result document.
class ResultTableSource final : public BodySource {
 public:
  ResultTableSource(Store& store, const std::string& job, api::ResultTable table)
      : document_(store, job), reader_(table) {}

  StatusOr<bool> append_next(std::string& piece) override {
    const std::size_t before = piece.size();
    bool more = true;
    while (more && piece.size() - before < kPieceBytes) {
      std::string text;
      const StatusOr<bool> read = document_.append_next(text);
      if (!read.ok()) {
        return read.status();
      }
      reader_.append(text, piece);
      more = *read;
    }
    if (!more) {
      reader_.end(piece);
    }
    return more;
  }
  [[nodiscard]] std::size_t held_bytes() const override {
    return document_.held_bytes() + reader_.held_bytes();
  }

 private:
  ResultSource document_;
  api::ResultTableReader reader_;
};

/// The points of a path.
class PointsSource final : public BodySource {
 public:
  explicit PointsSource(std::vector<Branch> branches) : table_(std::move(branches)) {}

  StatusOr<bool> append_next(std::string& piece) override { return table_.append_rows(piece, kPieceBytes); }
  [[nodiscard]] std::size_t held_bytes() const override { return table_.held_bytes(); }

 private:
  api::PointsTable table_;
};

}  // namespace

std::shared_ptr<BodySource> table_source(SweepStore& store, const SweepRecord& sweep, api::TableWriter writer,
                                         const PointQuery& query) {
  return std::make_shared<TableSource>(store, sweep, std::move(writer), query);
}

std::shared_ptr<BodySource> result_source(Store& store, const std::string& job) {
  return std::make_shared<ResultSource>(store, job);
}

StatusOr<std::shared_ptr<BodySource>> result_table_source(Store& store, const std::string& job,
                                                          api::ResultTable table) {
  if (table != api::ResultTable::points) {
    return std::shared_ptr<BodySource>(std::make_shared<ResultTableSource>(store, job, table));
  }
  StatusOr<StoredPath> path = store.path(job);
  if (!path.ok()) {
    return path.status();
  }
  return std::shared_ptr<BodySource>(std::make_shared<PointsSource>(std::move(path).value().branches));
}

StatusOr<Response> begin_body(std::shared_ptr<BodySource> source) {
  Response response;
  const StatusOr<bool> more = source->append_next(response.body);
  if (!more.ok()) {
    return more.status();
  }
  if (*more) {
    response.rest = std::move(source);
  }
  return response;
}

}  // namespace snapthrough::server::http
