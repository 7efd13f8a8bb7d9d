// The options of an analysis that are refused, before anything is computed.
#include <gtest/gtest.h>

#include <limits>

#include "medial_vk/analysis.h"
#include "medial_vk/prepare.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

Error refusal(const AnalysisOptions& options) {
  const IndexedMesh mesh = IndexedMesh::build(prepare_mesh(test::make_box({1, 1, 1})).value()).value();
  bool extracted = false;
  const Extractor extractor = [&](const IndexedMesh&, const ExtractionOptions&, const ProgressCallback&,
                                  const std::stop_token&) -> Result<Extraction> {
    extracted = true;
    return Extraction();
  };
  const Result<Analysis> analysis = analyse(mesh, options, extractor);
  EXPECT_FALSE(extracted);
  EXPECT_FALSE(analysis.ok());
  return analysis.ok() ? Error() : analysis.error();
}

TEST(Analyse, RefusesSharesOfTheVolumeOutsideOfZeroToOne) {
  for (const double share : {-0.5, 2.0, std::numeric_limits<double>::quiet_NaN()}) {
    AnalysisOptions options;
    options.keep_volume = share;
    const Error error = refusal(options);
    EXPECT_EQ(error.code, ErrorCode::kUsage);
    EXPECT_EQ(error.message, "`keep_volume` must be 0 to 1");
  }
}

TEST(Analyse, RefusesOptionsOfSheetsThatAreOutOfRange) {
  for (double SheetOptions::*const member :
       {&SheetOptions::angle, &SheetOptions::crease, &SheetOptions::border, &SheetOptions::width}) {
    for (const double value : {-1.0, 181.0, std::numeric_limits<double>::quiet_NaN()}) {
      AnalysisOptions options;
      options.sheets.emplace();
      (*options.sheets).*member = value;
      EXPECT_EQ(refusal(options).code, ErrorCode::kUsage);
    }
  }
}

TEST(Analyse, RefusesMeasuresOfSheetsWithoutSheets) {
  AnalysisOptions options;
  options.volumes = true;
  EXPECT_EQ(refusal(options).code, ErrorCode::kUsage);
}

TEST(MedialMeshOfNoPoints, RefusesLengthsThatAreNone) {
  for (const double length : {-1.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(make_medial_mesh({}, {}, {.growth = length}).error().code, ErrorCode::kUsage);
    EXPECT_EQ(make_medial_mesh({}, {}, {.epsilon = length}).error().code, ErrorCode::kUsage);
  }
}

}  // namespace
}  // namespace medial_vk
