// Each malformed config gives one line: file, line, key, what is wrong and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/config/reading/config_reading.h"
#include "tests/io/config_file.h"

namespace howl::config_malformed_test {
namespace {

using testing::HasSubstr;

struct Malformed {
  std::string name;
  std::string text;
  int line = 0;
  std::string key;       // empty: the message has none
  std::string wrong;     // a part of what the message says is wrong
  std::string expected;  // a part of what it says was expected
};

const std::string kNumbers = "frequency_hz: 219.9, phase_deg: -5.74, gain: 12.14";
const std::string kGood = "experiments:\n  - {name: exp1, phi: 0.56, " + kNumbers + "}\n";

// One experiment, with `numbers` on line 4.
std::string Experiment(const std::string& numbers) {
  return "experiments:\n  - name: exp1\n    phi: 0.56\n    " + numbers + "\n";
}

std::string Bomb() {
  std::string text = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + alias;
    for (int j = 1; j < 10; ++j) text += ", " + alias;
    text += "]\n";
  }
  return text;
}

std::vector<Malformed> Cases() {
  const std::string e0 = "experiments[0]";
  return {
      // What is not a config at all.
      {"Empty", "", 1, "experiments", "empty", "mapping"},
      {"CommentsAlone", "# nothing\n\n", 1, "experiments", "empty", "mapping"},
      {"NullDocument", "---\n~\n", 2, "experiments", "empty", "mapping"},
      {"ListAtTop", "- 1\n- 2\n", 1, "experiments", "is a list", "mapping"},
      {"BareWord", "hello\n", 1, "experiments", "bare value", "mapping"},
      {"Binary",
       std::string("title: x\n\x7f"
                   "ELF\x02\x01\x00\x00",
                   17),
       2, "title", "0x7f", "UTF-8"},
      // A record in the config's place, whatever its size.
      {"Csv", "t,p,q\n0,1.5,-2\n0.0002,1.4,-2.1\n0.0004,1.2,-2.2\n", 1, "experiments",
       "a table of numbers", "pressure: p, heat_release: q, sampling_hz"},
      {"CsvOfMegabytes",
       [] {
         std::string text = "p,q\n";
         for (int i = 0; i < 500'000; ++i) text += std::to_string(i) + ",0.125\n";
         return text;
       }(),
       1, "experiments", "a table of numbers", "pressure: p, heat_release: q"},
      {"TableWithoutHeader", "1 2e-3\n3 -4\n5 6\n", 1, "experiments", "a table of numbers",
       "pressure: 1, heat_release: 2"},
      {"OneColumn", "1.5\n2.5\n3.5\n4.5\n", 1, "experiments", "a table of numbers",
       "pressure: 1, sampling_hz"},
      {"SemicolonsAndTabs", "Zeit [s];\"p\"\r\n0;1\r\n1;2\r\n2;3\r\n", 1, "experiments",
       "a table of numbers", "record: {file: "},
      {"Hdf5", std::string("\x89HDF\r\n\x1a\n\0\0", 10), 1, "experiments", "an HDF5 file",
       "record: {file: "},
      {"Matlab", "MATLAB 5.0 MAT-file, Platform: GLNXA64", 1, "experiments", "a MATLAB file",
       "record: {file: "},
      {"Gzip", "\x1f\x8b\x08", 1, "experiments", "a gzip file", "record: {file: "},
      {"NotUtf8", "title: caf\xe9\n" + kGood, 1, "title", "0xe9 at column 11", "UTF-8"},
      {"Utf16",
       std::string("\xff\xfe"
                   "t\0i\0",
                   6),
       1, "", "0xff", "UTF-8"},
      // NOLINTNEXTLINE(bugprone-string-constructor): a line as long as this is meant.
      {"LineOf10MB", "title: t\nexperiments: [" + std::string(10'000'000, 'x') + "]\n", 2,
       "experiments", "longer than 256 kB", "shorter lines"},
      {"FileOf5MB",
       kGood +
           [] {
             std::string comments;
             while (comments.size() < 5'000'000) comments += "# " + std::string(1000, 'c') + "\n";
             return comments;
           }(),
       4184, "name", "larger than 4 MB", "smaller"},
      {"TwoDocuments", kGood + "---\n" + kGood, 3, "---", "second YAML document", "one config"},
      // YAML that does not parse, or should not.
      {"OpenBrace", "experiments:\n  - {name: exp1, phi: 0.56\n", 2, "name", "not YAML", "}"},
      {"OpenBraceInTheMiddle",
       "experiments:\n  - {name: exp1, phi: 0.56 # } [\n  - {name: 'e}', phi: 0.56}\n", 2, "name",
       "{ is not closed", "}"},
      {"WrongBracket", kGood + "family: {test: {xi_max: 0.3]}\n", 3, "family", "{ is not closed",
       "}"},
      {"CommaForgotten", kGood + "solver: {starts: 3 max_iterations: 4}\n", 3, "solver", "not YAML",
       "a comma"},
      {"OpenBracket", "experiments: [\n", 1, "experiments", "not YAML", "]"},
      {"OpenQuote", kGood + "title: \"no end\n", 3, "title", "not YAML", "closing quote"},
      {"ColonInText", kGood + "title: one: two\n", 3, "title", "not YAML", "quotes"},
      {"BadIndent", "experiments:\n  - name: exp1\n   phi: 0.5\n", 3, "phi", "not YAML", "column"},
      {"Tab", "experiments:\n\t- {name: exp1}\n", 2, "name", "tab", "spaces"},
      {"UnknownAnchor", kGood + "model: *nothing\n", 3, "model", "not YAML", "anchor"},
      {"AliasLoop", kGood + "model: &a [*a]\n", 3, "model[0]", "stands inside", "without a loop"},
      {"AliasLoopInMapping", kGood + "model: &a {modes: *a}\n", 3, "model.modes", "stands inside",
       "without a loop"},
      {"AliasBomb", Bomb(), 6, "a5[0]", "aliases make more than", "fewer"},
      {"TooDeep", "title: " + std::string(200, '[') + std::string(200, ']') + "\n", 1,
       "title[0][0][0][0][0][0][0][0][0][0][0][0][0][0][0]", "nested", "schema"},
      {"ManyBrackets", "title: " + std::string(200'000, '[') + "\n", 1, "title", "[ is not closed",
       "]"},
      {"ListAsKey", kGood + "? [a, b]\n: 1\n", 3, "", "used as a key", "name"},
      {"NullKey", kGood + "~: 1\n", 3, "", "empty or null", "name of a key"},
      {"Tag", kGood + "title: !secret x\n", 3, "title", "!secret", "plain value"},
      {"DuplicateKey", Experiment(kNumbers.substr(0, 19) + "\n    gain: 2\n    gain: 3"), 6,
       e0 + ".gain", "given twice (first on line 5)", "once"},
      {"DuplicateSection", kGood + "model: {modes: 1}\ntitle: t\nmodel: {modes: 2}\n", 5, "model",
       "given twice (first on line 3)", "once"},
      {"LongText", kGood + "title: " + std::string(5000, 'x') + "\n", 3, "title", "5000 characters",
       "at most 4096"},
      // Unknown keys.
      {"NoExperiments", "title: t\n", 1, "experiments", "is missing", "a list"},
      {"NullExperiments", "title: t\nexperiments:\nmodel: {modes: 1}\n", 2, "experiments",
       "has no value", "a list"},
      {"EmptyExperiments", "experiments: []\n", 1, "experiments", "list is empty",
       "a list with at least one item"},
      {"UnknownAtTop", kGood + "modle: {modes: 1}\n", 3, "modle", "not a known key", "model"},
      {"Misspelt", Experiment("frequncy_hz: 219.9"), 4, e0 + ".frequncy_hz", "not a known key",
       "frequency_hz"},
      {"WrongUnitKey", Experiment("frequency_khz: 0.2199"), 4, e0 + ".frequency_khz",
       "not a known key", "frequency_hz (limit-cycle frequency in Hz)"},
      {"RadiansKey", Experiment("phase_rad: -0.1"), 4, e0 + ".phase_rad", "not a known key",
       "phase_deg (phase from q to p in degrees"},
      {"MillisecondsKey", kGood + "parameters: {tau_ms: {initial: 3.4}}\n", 3, "parameters.tau_ms",
       "not a known key", "tau_s (delay of the flame in seconds)"},
      {"KeyWithoutUnit", Experiment("phase: -5.74"), 4, e0 + ".phase", "not a known key",
       "phase_deg"},
      {"KeyInCapitals", kGood + "Model: {modes: 1}\n", 3, "Model", "not a known key", "model"},
      {"KeyOfAnotherPlace", kGood + "members: 10\n", 3, "members", "not a known key here",
       "under family"},
      {"KeyLikeNothing", Experiment("colour: red"), 4, e0 + ".colour", "not a known key",
       "one of name, phi, "},
      {"OperatingParameterNotNamed",
       "experiments:\n  - {name: exp1, air_slpm: 20, " + kNumbers + "}\n", 2, e0 + ".air_slpm",
       "not a known key", "operating_parameter"},
      {"DecimalCommaInBraces", "experiments:\n  - {name: exp1, phi: 0,56, " + kNumbers + "}\n", 2,
       e0 + ".56", "a number stands where a key", "decimal point"},
      // Missing keys.
      {"NoPhi", "experiments:\n  - {name: exp1, " + kNumbers + "}\n", 2, e0 + ".phi", "is missing",
       "a number (operating parameter"},
      {"NoRenamedPhi",
       "operating_parameter: air_slpm\nexperiments:\n  - {name: exp1, phi: 1, " + kNumbers + "}\n",
       3, e0 + ".phi", "not a known key", "puts air_slpm in the place of phi"},
      {"NoName", "experiments:\n  - {phi: 0.56, " + kNumbers + "}\n", 2, e0 + ".name", "is missing",
       "text"},
      {"NoGain", Experiment("frequency_hz: 219.9\n    phase_deg: 0"), 2, e0 + ".gain", "is missing",
       "together"},
      {"NeitherNumbersNorRecord", Experiment("reliable: true"), 2, e0 + ".frequency_hz",
       "is missing", "or a record"},
      {"SlopeStdAlone",
       Experiment(kNumbers.substr(0, 0) + "flame_slope_std: 1e-6\n    "
                                          "frequency_hz: 1\n    phase_deg: 1\n    gain: 1"),
       4, e0 + ".flame_slope_std", "no flame_slope", "flame_slope too"},
      // Wrong types.
      {"TextForNumber", Experiment("gain: loud"), 4, e0 + ".gain", "\"loud\" is text",
       "a number above 0 (|p| / |q| at frequency_hz)"},
      {"NumberWithUnit", Experiment("frequency_hz: 219.9 Hz"), 4, e0 + ".frequency_hz",
       "\"219.9 Hz\" carries a unit", "the number alone"},
      {"NumberInQuotes", Experiment("gain: \"12.14\""), 4, e0 + ".gain", "quotes",
       "without quotes"},
      {"DecimalComma", Experiment("gain: 12,14"), 4, e0 + ".gain", "has a comma", "decimal point"},
      {"NaN", Experiment("gain: .nan"), 4, e0 + ".gain", ".nan is not a finite number", "a number"},
      {"BareNaN", Experiment("gain: NaN"), 4, e0 + ".gain", "\"NaN\" is not a finite number",
       "a number"},
      {"Infinity", Experiment("phase_deg: -.inf"), 4, e0 + ".phase_deg", "not a finite number",
       "a number from -360 to 360"},
      {"Overflow", Experiment("gain: 1e999"), 4, e0 + ".gain", "1e999 is not a finite number",
       "a number"},
      {"BooleanForNumber", Experiment("gain: yes"), 4, e0 + ".gain", "yes means true", "a number"},
      {"ListForNumber", Experiment("gain: [1, 2]"), 4, e0 + ".gain", "a list", "a number"},
      {"NoValue", Experiment("gain:\n    phase_deg: 1"), 4, e0 + ".gain", "has no value",
       "a number"},
      {"MappingForList", "experiments:\n  exp1: {phi: 0.5}\n", 2, "experiments", "a mapping",
       "a list"},
      {"NumberForExperiment", "experiments:\n  - 3\n", 2, e0, "3 is a number", "a mapping"},
      {"FractionForCount", kGood + "solver: {starts: 7.5}\n", 3, "solver.starts",
       "7.5 is not a whole number", "a whole number from 1"},
      {"HugeCount", kGood + "solver: {starts: 123456789012345678901234567890}\n", 3,
       "solver.starts", "out of range", "a whole number from 1"},
      {"NumberForSwitch", Experiment("reliable: 1"), 4, e0 + ".reliable", "1 is a number",
       "true or false"},
      {"BooleanForName", "experiments:\n  - {name: on, phi: 1, " + kNumbers + "}\n", 2,
       e0 + ".name", "on means true", "in quotes it is text"},
      {"FixedToNumber", kGood + "parameters: {xi: {fixed: 0.2}}\n", 3, "parameters.xi.fixed",
       "0.2 is a number", "true or false (true: held at initial)"},
      {"OffForParameter", kGood + "parameters: {xi: off}\n", 3, "parameters.xi", "off means false",
       "a mapping"},
      // Values out of range.
      {"NegativeGain", Experiment("gain: -12.14"), 4, e0 + ".gain", "-12.14 is out of range",
       "a number above 0"},
      {"ZeroFrequency", Experiment("frequency_hz: 0"), 4, e0 + ".frequency_hz", "0 is out of range",
       "a number above 0"},
      {"NegativeFrequency", Experiment("frequency_hz: -219.9"), 4, e0 + ".frequency_hz",
       "out of range", "a number above 0"},
      {"PhaseBeyondATurn", Experiment("phase_deg: 400"), 4, e0 + ".phase_deg",
       "400 is out of range", "from -360 to 360"},
      {"RisingFlame", Experiment("flame_slope: 0.703e-4"), 4, e0 + ".flame_slope",
       "0.703e-4 is out of range", "at most 0"},
      {"ZeroStd", Experiment("gain_std: 0"), 4, e0 + ".gain_std", "out of range", "above 0"},
      {"LineAtZero", Experiment("lines: [{frequency_hz: 750}, {frequency_hz: 0}]"), 4,
       e0 + ".lines[1].frequency_hz", "out of range", "above 0"},
      {"NineModes", kGood + "model: {modes: 9}\n", 3, "model.modes", "9 is out of range",
       "from 1 to 8"},
      {"NoMembers", kGood + "family: {members: 0}\n", 3, "family.members", "out of range",
       "from 1 to 100000000"},
      {"NegativeTolerance", kGood + "family: {test: {gain_tolerance: -0.01}}\n", 3,
       "family.test.gain_tolerance", "out of range", "of at least 0 or null"},
      {"InfiniteTolerance", kGood + "family: {test: {xi_max: .inf}}\n", 3, "family.test.xi_max",
       "not a finite number", "null: off"},
      {"NameWithSlash", "experiments:\n  - {name: a/b, phi: 1, " + kNumbers + "}\n", 2,
       e0 + ".name", "\"a/b\" cannot be used", "no comma, quote, slash"},
      {"EmptyName", "experiments:\n  - {name: '', phi: 1, " + kNumbers + "}\n", 2, e0 + ".name",
       "the text is empty", "text"},
      {"LongName", "experiments:\n  - {name: " + std::string(101, 'n') + ", phi: 1}\n", 2,
       e0 + ".name", "101 characters", "at most 100"},
      {"UnknownLoss", kGood + "residuals:\n  gain_equality: {loss: hubert}\n", 4,
       "residuals.gain_equality.loss", "\"hubert\" is not known", "the nearest is huber"},
      {"UnknownMethod", kGood + "analysis: {method: fft}\n", 3, "analysis.method",
       "\"fft\" is not known", "one of local, paper, seed"},
      {"BadOperatingParameter", "operating_parameter: air flow\n" + kGood, 1, "operating_parameter",
       "\"air flow\" cannot be used", "air_slpm"},
      {"TakenOperatingParameter", "operating_parameter: gain\n" + kGood, 1, "operating_parameter",
       "already means", "another name"},
      // Rules that join several keys.
      {"DuplicateName", kGood + "  - {name: exp1, phi: 0.53, " + kNumbers + "}\n", 3,
       "experiments[1].name", "taken by the experiment on line 2", "another name"},
      {"BoundsReversed", kGood + "parameters:\n  xi:\n    min: 0.3\n    max: 0.01\n", 5,
       "parameters.xi.min", "min 0.3 is not below max 0.01", "min < max"},
      {"BoundAgainstDefault", kGood + "parameters:\n  xi: {min: 20}\n", 4, "parameters.xi.min",
       "max 10 (default)", "min < max"},
      {"MaxAgainstDefault", kGood + "parameters:\n  xi: {max: 1e-5}\n", 4, "parameters.xi.max",
       "min 0.0001 (default)", "min < max"},
      {"InitialOutside", kGood + "parameters:\n  xi: {initial: 0.5, max: 0.3}\n", 4,
       "parameters.xi.initial", "0.5 is outside", "from 0.0001 to 0.3"},
      {"FixedAtNothing", kGood + "parameters:\n  xi: {fixed: true}\n", 4, "parameters.xi.initial",
       "is missing", "the value to hold"},
      {"MWithOneMode", kGood + "parameters: {M: {initial: 2e4}}\n", 3, "parameters.M",
       "the model has one", "modes: 2"},
      {"BothMs", kGood + "model: {modes: 2}\nparameters: {M: {}, M_over_N: {}}\n", 4,
       "parameters.M_over_N", "is given with M", "only one"},
      {"UnknownExperiment", kGood + "residuals:\n  omega_prior:\n    experiments: [exp1, exp2]\n",
       5, "residuals.omega_prior.experiments[1]", "\"exp2\" is no experiment", "exp1"},
      {"FormWhereThereIsNone", kGood + "residuals: {tau_prior: {form: full}}\n", 3,
       "residuals.tau_prior.form", "not a known key", "one of "},
      {"WrongStdKey", kGood + "residuals: {gain_equality: {std_deg: 1}}\n", 3,
       "residuals.gain_equality.std_deg", "not a known key", "std_relative"},
      // Records.
      {"RecordAndNumbers", Experiment("gain: 2\n    record: {file: a.csv, sampling_hz: 5000}"), 4,
       e0 + ".gain", "is given with a record", "either record or published numbers"},
      {"RecordMissing", Experiment("record:\n      sampling_hz: 5000\n      file: absent.csv"), 6,
       e0 + ".record.file", "there is no file", "relative to the config's folder"},
      {"RecordIsFolder", Experiment("record: {file: ., sampling_hz: 5000}"), 4, e0 + ".record.file",
       "is a folder", "a file of samples"},
      {"RecordVariableNotSet",
       Experiment("record: {file: \"${HOWL_NO_SUCH}/a/b.csv\", sampling_hz: 5000}"), 4,
       e0 + ".record.file", "HOWL_NO_SUCH is not set", "the folder that has \"a/b.csv\""},
      {"RecordVariableOpen", Experiment("record: {file: \"${HOME/a.csv\", sampling_hz: 5000}"), 4,
       e0 + ".record.file", "${ without }", "${NAME}"},
      {"RecordVariableEmpty", Experiment("record: {file: \"${}/a.csv\", sampling_hz: 5000}"), 4,
       e0 + ".record.file", "names no environment variable", "letters"},
      {"RecordWithoutFile", Experiment("record: {sampling_hz: 5000}"), 4, e0 + ".record.file",
       "is missing", "file of samples"},
      {"RecordWithoutSampling", Experiment("record: {file: config.yaml}"), 4,
       e0 + ".record.sampling_hz", "is missing", "samples a second, or a column for time"},
      {"RecordColumnZero", Experiment("record: {file: config.yaml, pressure: 0, sampling_hz: 1}"),
       4, e0 + ".record.pressure", "0 is out of range", "at least 1"},
      {"RecordSameColumn",
       Experiment("record: {file: config.yaml, heat_release: p, sampling_hz: 1}"), 4,
       e0 + ".record.heat_release", "column of pressure already", "another"},
      {"RecordZeroScale",
       Experiment("record: {file: config.yaml, pressure_scale: 0, sampling_hz: 1}"), 4,
       e0 + ".record.pressure_scale", "leaves nothing", "other than 0"},
      // Of two mistakes the first in the file.
      {"FirstOfTwo", "modle: 1\n" + Experiment("gain: -1"), 1, "modle", "not a known key", "model"},
  };
}

class MalformedConfig : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedConfig, GivesOneLineWithLineKeyAndExpectation) {
  const Malformed& bad = GetParam();
  const ConfigFile file(bad.text);
  const std::string message = file.Mistake();
  RecordProperty("message", message);
  ASSERT_NE(message, "") << "was accepted";
  std::string start = file.Path().string() + ":" + std::to_string(bad.line) + ": ";
  if (!bad.key.empty()) start += bad.key + ": ";
  EXPECT_EQ(message.substr(0, start.size()), start) << message;
  const std::string rest = message.substr(std::min(start.size(), message.size()));
  const std::size_t expected = rest.find("expected ");
  ASSERT_NE(expected, std::string::npos) << message;
  EXPECT_THAT(rest.substr(0, expected), HasSubstr(bad.wrong)) << message;
  EXPECT_THAT(rest.substr(expected), HasSubstr(bad.expected)) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_FALSE(message.ends_with("...")) << "cut off: " << message;
}

INSTANTIATE_TEST_SUITE_P(All, MalformedConfig, testing::ValuesIn(Cases()),
                         [](const auto& param) { return param.param.name; });

TEST(MissingConfig, IsNamedWithoutALine) {
  const ConfigFile file(kGood);
  const std::string absent = (file.Folder() / "absent.yaml").string();
  try {
    LoadConfig(absent);
    FAIL() << "was accepted";
  } catch (const UserError& error) {
    EXPECT_EQ(std::string(error.what()),
              absent + ": there is no such file, expected a config (YAML)");
  }
  try {
    LoadConfig(file.Folder());
    FAIL() << "was accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("this is a folder, expected a config (YAML) file"));
  }
}

}  // namespace
}  // namespace howl::config_malformed_test
