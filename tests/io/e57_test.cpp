#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <functional>

#include "alea/io/atomic_file.hpp"
#include "alea/io/e57_page_writer.hpp"
#include "alea/io/e57_pages.hpp"
#include "tests/io/scans.hpp"
#include "tests/support/program.hpp"

namespace alea {
namespace {

using testing::error_of;
using testing::expect_same;
using testing::full_cloud;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

// RFC 3720, B.4: 32 bytes of zeros, of ones, and ascending.
TEST(E57, ChecksumHasItsKnownAnswers) {
  std::string ascending;
  for (int i = 0; i < 32; ++i) ascending += static_cast<char>(i);
  EXPECT_EQ(crc32c(std::string(32, '\0')), 0x8A9136AAU);
  EXPECT_EQ(crc32c(std::string(32, '\xFF')), 0x62A8AB43U);
  EXPECT_EQ(crc32c(ascending), 0x46DD794EU);
}

std::vector<ScanFile> two_scans() {
  std::vector<ScanFile> scans(2);
  scans[0].cloud = full_cloud(12345, false);
  scans[1].cloud = full_cloud(7, true);
  scans[0].name = "station <1> & north";
  scans[1].name = "station 2";
  for (ScanFile& scan : scans) {
    scan.pose = Eigen::Matrix4d::Identity();
    scan.pose->topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    scan.pose->topRightCorner<3, 1>() << 1e6, -2, 3.25;
  }
  return scans;
}

TEST(E57, SeveralScansKeepPointsPosesAndNames) {
  const TemporaryFolder folder;
  const std::vector<ScanFile> scans = two_scans();
  write_scans(folder.file("a.e57"), scans);
  const std::vector<ScanFile> back = read_scans(folder.file("a.e57"));
  ASSERT_EQ(back.size(), 2u);
  for (std::size_t s = 0; s < 2; ++s) {
    expect_same(scans[s].cloud, back[s].cloud);
    EXPECT_TRUE(back[s].pose->isApprox(*scans[s].pose, 1e-15));
    EXPECT_EQ(back[s].name, scans[s].name);
    EXPECT_EQ(back[s].cloud.scanner_position, Eigen::Vector3d(0, 0, 0));
  }
  EXPECT_EQ(read_cloud(folder.file("a.e57#2")).positions, scans[1].cloud.positions);
  const Cloud common = read_cloud(folder.file("a.e57"));
  ASSERT_EQ(common.size(), 12352u);
  const Eigen::Vector4d expected = *scans[1].pose * scans[1].cloud.positions[6].homogeneous();
  EXPECT_NEAR((common.positions.back() - expected.head<3>()).norm(), 0, 1e-8);
  EXPECT_THAT(error_of(folder.file("a.e57#3")), HasSubstr("scan 3 of 2"));
}

TEST(E57, OneFlippedBitAnywhereIsFound) {
  const TemporaryFolder folder;
  write_cloud(folder.file("a.e57"), full_cloud(100, false));
  const std::string good = testing::read_text(folder.file("a.e57"));
  for (std::size_t at = 0; at < good.size(); at += 97) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 16);
    write_file_atomically(folder.file("b.e57"), bad);
    EXPECT_NE(error_of(folder.file("b.e57")), "no error") << at;
  }
  for (const std::size_t size : {std::size_t{47}, std::size_t{1023}, good.size() - 1024}) {
    write_file_atomically(folder.file("b.e57"), good.substr(0, size));
    EXPECT_NE(error_of(folder.file("b.e57")), "no error") << size;
  }
}

// Appends the low bits of a value to a stream, least significant first.
void append_bits(std::string& stream, std::size_t& bit, std::uint64_t value, unsigned bits) {
  for (unsigned i = 0; i < bits; ++i, ++bit) {
    if (bit / 8 == stream.size()) stream += '\0';
    if (value >> i & 1) stream[bit / 8] = static_cast<char>(stream[bit / 8] | 1 << bit % 8);
  }
}

template <typename T>
void append(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

struct IntegerFile {
  std::int64_t maximum;  // of x; minimum -5
  std::size_t split;     // records in the first of two packets' x streams, in bytes
  std::vector<std::uint64_t> raw;
};

// A file with x as a scaled integer of any width, y and z constant, in two packets that split the
// x stream at any byte.
std::string integer_file(const IntegerFile& in, unsigned bits, const std::string& folder) {
  const std::string path = folder + "/bits.e57";
  AtomicFile file(path);
  E57PageWriter pages(file);
  std::string stream;
  std::size_t bit = 0;
  for (const std::uint64_t value : in.raw) append_bits(stream, bit, value, bits);
  const std::size_t split = std::min(in.split, stream.size());
  std::string packets;
  for (const std::string& part : {stream.substr(0, split), stream.substr(split)}) {
    const std::size_t length = (6 + 6 + part.size() + 3) / 4 * 4;
    packets += std::string("\1\0", 2);
    append(packets, static_cast<std::uint16_t>(length - 1));
    append(packets, std::uint16_t{3});
    append(packets, static_cast<std::uint16_t>(part.size()));
    append(packets, std::uint32_t{0});
    packets += part + std::string(length - 12 - part.size(), '\0');
  }
  std::string header("\1\0\0\0\0\0\0\0", 8);
  append(header, std::uint64_t{32 + packets.size()});
  append(header, std::uint64_t{80});
  append(header, std::uint64_t{0});
  pages.write(header + packets);
  pages.finish("<e57Root><data3D><vectorChild><points fileOffset=\"48\" recordCount=\"" +
               std::to_string(in.raw.size()) +
               "\"><prototype><cartesianX type=\"ScaledInteger\" minimum=\"-5\" maximum=\"" +
               std::to_string(in.maximum) +
               "\" scale=\"0.5\" offset=\"10\"/><cartesianY type=\"Integer\" minimum=\"4\" "
               "maximum=\"4\"/><cartesianZ type=\"Integer\" minimum=\"0\" maximum=\"0\"/>"
               "</prototype></points></vectorChild></data3D></e57Root>");
  file.commit();
  return path;
}

TEST(E57, IntegersOfEveryWidthAcrossPackets) {
  const TemporaryFolder folder;
  for (unsigned bits = 1; bits <= 63; ++bits) {
    const std::uint64_t top = (std::uint64_t{1} << bits) - 1;
    IntegerFile in{static_cast<std::int64_t>(top) - 5, 3 + bits, {}};
    for (std::uint64_t i = 0; i < 40; ++i) in.raw.push_back(i * 0x9E3779B97F4A7C15ULL & top);
    const Cloud cloud = read_cloud(integer_file(in, bits, folder.path().string()));
    ASSERT_EQ(cloud.size(), 40u) << bits;
    for (std::size_t i = 0; i < 40; ++i) {
      const double x = static_cast<double>(static_cast<std::int64_t>(in.raw[i]) - 5) * 0.5 + 10;
      ASSERT_EQ(cloud.positions[i], Eigen::Vector3d(x, 4, 0)) << bits << " bits, value " << i;
    }
  }
}

// The same file with another XML part.
std::string with_xml(const std::string& path, const std::function<void(std::string&)>& change) {
  std::string logical;
  const std::string file = testing::read_text(path);
  for (std::size_t at = 0; at < file.size(); at += 1024) logical += file.substr(at, 1020);
  const std::size_t xml = logical.find("<e57Root");
  const std::size_t end = logical.find("</e57Root>") + 10;
  std::string text = logical.substr(xml, end - xml);
  change(text);
  AtomicFile out(path + ".changed.e57");
  E57PageWriter pages(out);
  pages.write(logical.substr(48, xml - 48));
  pages.finish(text);
  out.commit();
  return path + ".changed.e57";
}

void insert_before(std::string& text, const std::string& mark, const std::string& what) {
  text.insert(text.find(mark), what);
}

TEST(E57, DeclaredRecordsThatAreNotThereAreAnError) {
  const TemporaryFolder folder;
  const std::string path = integer_file({250, 2, {1, 2, 3}}, 8, folder.path().string());
  EXPECT_EQ(read_cloud(path).size(), 3u);
  const std::string more = with_xml(path, [](std::string& xml) {
    const std::string count = "recordCount=\"3\"";
    xml.replace(xml.find(count), count.size(), "recordCount=\"4000\"");
  });
  EXPECT_THAT(error_of(more), HasSubstr("4000 records declared, its packets hold 3"));
}

// Thousands of scans of one section would be read thousands of times.
TEST(E57, ASectionBelongsToOneScan) {
  const TemporaryFolder folder;
  const IntegerFile in{250, 2, std::vector<std::uint64_t>(1000, 1)};
  const std::string path = integer_file(in, 8, folder.path().string());
  const std::string shared = with_xml(path, [](std::string& xml) {
    const std::size_t begin = xml.find("<vectorChild>"), end = xml.find("</data3D>");
    const std::string scan = xml.substr(begin, end - begin);
    for (int i = 0; i < 20; ++i) insert_before(xml, "</data3D>", scan);
  });
  EXPECT_THAT(error_of(shared), HasSubstr("is one of an earlier scan too"));
}

/// What the reader says of a scan whose pose holds this translation.
std::string error_of_translation(const std::string& elements) {
  const TemporaryFolder folder;
  const std::string path = integer_file({250, 2, {1, 2, 3}}, 8, folder.path().string());
  return error_of(with_xml(path, [&](std::string& xml) {
    insert_before(xml, "<points", "<pose><translation>" + elements + "</translation></pose>");
  }));
}

TEST(E57, APoseThatIsNotFiniteIsNamed) {
  EXPECT_THAT(error_of_translation("<x>nan</x>"),
              HasSubstr("scan 1: pose: expected finite numbers"));
}

TEST(E57, APoseThatIsNoNumberIsNamed) {
  EXPECT_THAT(error_of_translation("<x>1</x><y>b</y>"), HasSubstr("scan 1: pose: translation y"));
}

// The tree would take 25 times the memory of the text.
TEST(E57, MoreElementsThanMemoryIsMeantForAreRefused) {
  const TemporaryFolder folder;
  const std::string path = integer_file({250, 2, {1, 2, 3}}, 8, folder.path().string());
  const auto with_elements = [&](int count) {
    return with_xml(path, [&](std::string& xml) {
      std::string elements;
      for (int i = 0; i < count; ++i) elements += "b<a/>";
      insert_before(xml, "</e57Root>", elements);
    });
  };
  EXPECT_EQ(error_of(with_elements(10000)), "no error");
  EXPECT_THAT(error_of(with_elements(100000)), HasSubstr("elements and"));
}

}  // namespace
}  // namespace alea
