// A program of its own, since glog can be initialised for a whole process only.
#include <glog/logging.h>
#include <gmock/gmock.h>

#include <cmath>

#include "fit/least_squares.hpp"

namespace logging_test {
namespace {

using testing::HasSubstr;

struct Fitted {
  fit::SearchReport report;
  std::string standard_error;
};

/// A search whose first step leads to where the Jacobian is not finite, of which Ceres writes a message.
Fitted fit_that_ceres_gives_up() {
  const fit::ResidualModel model{
      {{"x", 1}}, 1, [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
        r[0] = 3 - x[0];
        if (jacobian != nullptr) (*jacobian)(0, 0) = x[0] == 1 ? -1 : std::nan("");
      }};
  Eigen::VectorXd x = Eigen::VectorXd::Ones(1);
  testing::internal::CaptureStderr();
  const fit::SearchReport report = fit::minimise(model, x);
  return {report, testing::internal::GetCapturedStderr()};
}

TEST(LoggingOfCeres, DoesNotReachStandardError) {
  const Fitted fitted = fit_that_ceres_gives_up();
  EXPECT_EQ(fitted.standard_error, "");
  EXPECT_EQ(fitted.report.outcome, fit::SearchReport::Outcome::not_finite);
  EXPECT_THAT(fitted.report.why, HasSubstr("evaluation failed"));
}

TEST(LoggingOfCeres, LeavesTheLevelThatAProgramHasSet) {
  FLAGS_minloglevel = google::GLOG_WARNING;
  EXPECT_EQ(fit_that_ceres_gives_up().standard_error, "");
  EXPECT_EQ(FLAGS_minloglevel, google::GLOG_WARNING);
  FLAGS_minloglevel = google::GLOG_INFO;
}

TEST(LoggingOfCeres, GoesWhereAProgramSendsItThatHasInitialisedGlog) {
  FLAGS_logtostderr = true;
  google::InitGoogleLogging("logging_test");
  EXPECT_THAT(fit_that_ceres_gives_up().standard_error, HasSubstr("evaluation failed"));
  google::ShutdownGoogleLogging();
  FLAGS_logtostderr = false;
  EXPECT_EQ(fit_that_ceres_gives_up().standard_error, "");
}

}  // namespace
}  // namespace logging_test
