#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/io/cloud_sink.hpp"
#include "alea/io/field_role.hpp"

namespace alea {

enum class ScalarType {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

/// Bytes of one value.
std::size_t size_of(ScalarType type);

/// One field of fixed-size records: element i lies at offset + i * stride.
struct RecordColumn {
  std::optional<FieldRole> role;
  ScalarType type = ScalarType::float32;
  std::size_t offset = 0;
  std::size_t stride = 0;
};

/// Fixed-size binary records, e.g. the vertices of a binary PLY.
struct RecordTable {
  std::vector<RecordColumn> columns;
  bool big_endian = false;
  std::size_t image_columns = 0;  ///< of points that lie row by row (PCD); 0: no image
};

/// Copies records [begin, end) of `bytes` into the cloud's arrays from index `at` on, each field to
/// where its role says; fields without a role or without an array are skipped. Integer
/// colours of 8 bits are widened (v * 257), float colours are taken as 0 to 1. The caller has
/// checked that the records lie inside `bytes`.
void copy_records(const RecordTable& table, std::string_view bytes, Cloud& cloud, std::size_t at,
                  std::size_t begin, std::size_t end);

/// Adds `count` records to the sink, batch by batch; `release(done)`, if any, is told after each
/// how many records are done.
void append_records(CloudSink& sink, const RecordTable& table, std::string_view bytes,
                    std::size_t count, const std::function<void(std::size_t done)>& release);

}  // namespace alea
