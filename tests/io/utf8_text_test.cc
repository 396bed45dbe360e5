// Texts that are nearly UTF-8, as a cut or another encoding leaves them, and what is said of them.
#include "io/utf8_text.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "io/user_error.h"
#include "tests/io/config_file.h"

namespace howl::utf8_text_test {
namespace {

using testing::HasSubstr;

TEST(Utf8Text, EachKindOfCharacterHasItsLength) {
  for (const std::string text : {"a", "\xc3\xa8", "\xe2\x82\xac", "\xf0\x9f\x94\xa5",
                                 "\xe0\xa0\x80", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(Utf8Length(text + "x"), text.size()) << text;
    EXPECT_EQ(AsUtf8Text(text), text);
    EXPECT_EQ(Utf8Length(text.substr(0, text.size() - 1)), 0U) << text;  // cut
  }
  EXPECT_EQ(Utf8Length(""), 0U);
}

// JSON takes the same for text: what is believed of a config can be written to results.
TEST(Utf8Text, IsWhatJsonTakes) {
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::string tail = first < 0xe0 ? "" : first < 0xf0 ? "\x80" : "\x80\x80";
      const std::string text = std::string{char(first), char(second)} + tail;
      bool is_text = true;
      for (std::size_t i = 0; is_text && i < text.size();) {
        const std::size_t length = Utf8Length(std::string_view(text).substr(i));
        is_text = length > 0;
        i += length;
      }
      EXPECT_EQ(is_text, AsUtf8Text(text) == text);
      if (is_text) {
        EXPECT_NO_THROW((void)nlohmann::json(text).dump()) << first << " " << second;
      } else {
        EXPECT_THROW((void)nlohmann::json(text).dump(), nlohmann::json::type_error)
            << first << " " << second;
        EXPECT_NO_THROW((void)nlohmann::json(AsUtf8Text(text)).dump());
      }
    }
  }
}

TEST(Utf8Text, AMessageIsTextThoughItWasCut) {
  const UserError half("f", 1, "k\xc3", std::string("x\xe2\x82"));
  EXPECT_STREQ(half.what(), "f:1: k?: x??");
  std::string long_text = "x";
  while (long_text.size() < 1000) long_text += "\xc3\xa8";
  const UserError cut("f", 1, "k", long_text);
  EXPECT_EQ(AsUtf8Text(cut.what()), cut.what());
}

TEST(Utf8Text, AConfigWithHalfACharacterIsRefused) {
  for (const std::string name : {"\xed\xa0\x80", "\xe0\x80\x80", "\xf4\x90\x80\x80", "\xc3"}) {
    const ConfigFile file("experiments:\n  - {name: a" + name +
                          ", phi: 0.5, frequency_hz: 200, phase_deg: -5, gain: 12}\n");
    EXPECT_THAT(file.Mistake(), HasSubstr("is not text, expected a YAML file in UTF-8"));
  }
}

}  // namespace
}  // namespace howl::utf8_text_test
