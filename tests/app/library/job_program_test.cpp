// The commands that jobs of the pages become. That they run is shown in the browser (tests/browser/roles.mjs).
#include "app/library/job_program.h"

#include <gtest/gtest.h>

#include "tests/fixtures/folders.h"

namespace seldinger::app {
namespace {

using Words = std::vector<std::string>;

web::Job job_of(web::JobKind kind, std::map<std::string, std::string> wish) {
  web::Job job;
  job.kind = kind;
  job.wish = std::move(wish);
  return job;
}

TEST(JobProgram, AnImportReadsWhatWasSentAsTheCommandDoes) {
  web::Job job = job_of(
      web::JobKind::import_ct,
      {{"title", "--by"}, {"modality", "xray"}, {"position", ""}, {"face", "crop"}, {"no_burned_in_text", "yes"}});
  job.files = {{"0000.nii.gz", 3}};
  EXPECT_EQ(words_of_job(job, "/j"), (Words{"import", "/j/files/0000.nii.gz", "--title", "--by", "--modality",
                                            "xray", "--face", "crop", "--no-burned-in-text"}));
  job.files.push_back({"0001.dcm", 3});
  job.wish = {{"no_burned_in_text", ""}};
  EXPECT_EQ(words_of_job(job, "/j"), (Words{"import", "/j/files"})) << "several are a folder";
}

TEST(JobProgram, AStudysReportAndExportStayInTheJobsFolder) {
  const std::map<std::string, std::string> wish = {{"study", "S"}, {"title", "Needles"}};
  EXPECT_EQ(words_of_job(job_of(web::JobKind::study_report, wish), "/j"),
            (Words{"report", "validity", "--study", "S", "--out", "/j/results/validity-report.html"}));
  EXPECT_EQ(words_of_job(job_of(web::JobKind::study_export, wish), "/j"),
            (Words{"export", "--study", "S", "--raw", "none", "--out", "/j/results"}));
}

TEST(JobProgram, WhoseAccountIsGoneGetsNothingDone) {
  const auto folder = fixtures::fresh_test_folder("app");
  const auto end =
      job_runner(folder / "library")(job_of(web::JobKind::study_report, {}), folder, [](std::string_view) {}, {});
  EXPECT_FALSE(end.done);
  EXPECT_EQ(end.said, "Your account is closed.");
}

}  // namespace
}  // namespace seldinger::app
