#include "alea/io/record_columns.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "alea/io/byte_order.hpp"

namespace alea {
namespace {

// Calls body.template operator()<T>() with the C++ type of a scalar.
template <typename Body>
void with_type(ScalarType type, const Body& body) {
  switch (type) {
    case ScalarType::int8:
      return body.template operator()<std::int8_t>();
    case ScalarType::uint8:
      return body.template operator()<std::uint8_t>();
    case ScalarType::int16:
      return body.template operator()<std::int16_t>();
    case ScalarType::uint16:
      return body.template operator()<std::uint16_t>();
    case ScalarType::int32:
      return body.template operator()<std::int32_t>();
    case ScalarType::uint32:
      return body.template operator()<std::uint32_t>();
    case ScalarType::int64:
      return body.template operator()<std::int64_t>();
    case ScalarType::uint64:
      return body.template operator()<std::uint64_t>();
    case ScalarType::float32:
      return body.template operator()<float>();
    case ScalarType::float64:
      return body.template operator()<double>();
  }
}

template <typename T>
std::uint16_t colour_value(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return static_cast<std::uint16_t>(
        std::lround(std::clamp(std::isfinite(value) ? value : T{0}, T{0}, T{1}) * 65535));
  else if constexpr (sizeof(T) == 1)
    return static_cast<std::uint16_t>(static_cast<std::uint8_t>(value) * 257);
  else
    return static_cast<std::uint16_t>(
        std::clamp<std::int64_t>(static_cast<std::int64_t>(value), 0, 65535));
}

template <typename T>
std::int32_t index_value(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return std::abs(value) < T{2e9} ? static_cast<std::int32_t>(value) : -1;
  else
    return static_cast<std::int32_t>(value);
}

template <typename T>
std::uint32_t packed_bits(T value) {
  if constexpr (std::is_same_v<T, float>)
    return std::bit_cast<std::uint32_t>(value);
  else
    return static_cast<std::uint32_t>(value);
}

struct Range {
  const char* first;  // of the column's first element
  std::size_t stride;
  std::size_t at;
  std::size_t count;
};

// x, y and z of one type, one behind the other: one pass instead of three.
template <typename T, bool swapped>
void copy_positions(const Range& range, Cloud& cloud) {
  const char* from = range.first;
  for (std::size_t i = range.at; i < range.at + range.count; ++i, from += range.stride)
    cloud.positions[i] = {static_cast<double>(load_value<T, swapped>(from)),
                          static_cast<double>(load_value<T, swapped>(from + sizeof(T))),
                          static_cast<double>(load_value<T, swapped>(from + 2 * sizeof(T)))};
}

template <typename T, bool swapped>
void copy_column(FieldRole role, const Range& range, Cloud& cloud) {
  const auto each = [&](const auto& store) {
    const char* from = range.first;
    for (std::size_t i = range.at; i < range.at + range.count; ++i, from += range.stride)
      store(i, load_value<T, swapped>(from));
  };
  using enum FieldRole;
  const auto axis = static_cast<int>(role);
  switch (role) {
    case x:
    case y:
    case z:
      return each([&](std::size_t i, T v) { cloud.positions[i][axis] = static_cast<double>(v); });
    case intensity:
      if (cloud.has_intensity())
        each([&](std::size_t i, T v) { cloud.intensity[i] = static_cast<float>(v); });
      return;
    case red:
    case green:
    case blue:
      if (!cloud.colours.empty())
        each([&](std::size_t i, T v) {
          cloud.colours[i][axis - static_cast<int>(red)] = colour_value(v);
        });
      return;
    case rgb:
      if constexpr (sizeof(T) == 4)
        if (!cloud.colours.empty())
          each([&](std::size_t i, T v) { cloud.colours[i] = unpacked_colour(packed_bits(v)); });
      return;
    case nx:
    case ny:
    case nz:
      if (!cloud.normals.empty())
        each([&](std::size_t i, T v) {
          cloud.normals[i][axis - static_cast<int>(nx)] = static_cast<float>(v);
        });
      return;
    case row:
      if (!cloud.rows.empty()) each([&](std::size_t i, T v) { cloud.rows[i] = index_value(v); });
      return;
    case column:
      if (!cloud.columns.empty())
        each([&](std::size_t i, T v) { cloud.columns[i] = index_value(v); });
      return;
  }
}

}  // namespace

std::size_t size_of(ScalarType type) {
  std::size_t size = 0;
  with_type(type, [&]<typename T>() { size = sizeof(T); });
  return size;
}

namespace {

bool starts_with_positions(const std::vector<RecordColumn>& columns) {
  if (columns.size() < 3) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (columns[k].role != static_cast<FieldRole>(k) || columns[k].type != columns[0].type ||
        columns[k].stride != columns[0].stride ||
        columns[k].offset != columns[0].offset + k * size_of(columns[0].type))
      return false;
  return true;
}

template <bool swapped>
void copy_all(const RecordTable& table, std::string_view bytes, Cloud& cloud, std::size_t at,
              std::size_t begin, std::size_t end) {
  const bool together = starts_with_positions(table.columns);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const RecordColumn& field = table.columns[c];
    if (!field.role || (together && (c == 1 || c == 2))) continue;
    const Range range{bytes.data() + field.offset + begin * field.stride, field.stride, at,
                      end - begin};
    with_type(field.type, [&]<typename T>() {
      if (together && c == 0)
        copy_positions<T, swapped>(range, cloud);
      else
        copy_column<T, swapped>(*field.role, range, cloud);
    });
  }
}

}  // namespace

void copy_records(const RecordTable& table, std::string_view bytes, Cloud& cloud, std::size_t at,
                  std::size_t begin, std::size_t end) {
  if (table.big_endian)
    copy_all<true>(table, bytes, cloud, at, begin, end);
  else
    copy_all<false>(table, bytes, cloud, at, begin, end);
  for (std::size_t i = begin; table.image_columns > 0 && i < end; ++i) {
    cloud.rows[at + i - begin] = static_cast<std::int32_t>(i / table.image_columns);
    cloud.columns[at + i - begin] = static_cast<std::int32_t>(i % table.image_columns);
  }
}

void append_records(CloudSink& sink, const RecordTable& table, std::string_view bytes,
                    std::size_t count, const std::function<void(std::size_t)>& release) {
  sink.reserve(count);
  for (std::size_t first = 0; first < count; first += batch_points) {
    const std::size_t size = std::min(batch_points, count - first);
    sink.append(size, [&](Cloud& cloud, std::size_t at, std::size_t from, std::size_t to) {
      copy_records(table, bytes, cloud, at, first + from, first + to);
      return DroppedPoints{};
    });
    if (release) release(first + size);
  }
}

}  // namespace alea
