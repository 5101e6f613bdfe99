// An example of every procedure, on the made-up files of docs/statistics: tests/e2e/stats_test.cpp types them.
#include <array>

#include "app/statistics/procedures.h"

namespace seldinger::app {
namespace {

#define COURSE "--csv docs/statistics/course.csv "
#define ATTEMPTS "--csv docs/statistics/attempts.csv "

constexpr ProcedureExample kExamples[] = {
    {"describe", COURSE "--value score --group experience"},
    {"shapiro", COURSE "--value score --group experience"},
    {"brown_forsythe", COURSE "--value score --group experience"},
    {"welch", COURSE "--value score --group experience --options order=expert:novice"},
    {"student", COURSE "--value score --group site"},
    {"paired", COURSE "--value after,before --subject person"},
    {"mann_whitney", COURSE "--value contacts --group experience --options order=novice:expert"},
    {"brunner_munzel", COURSE "--value contacts --group experience --options order=novice:expert"},
    {"wilcoxon", COURSE "--value after,before"},
    {"kruskal", COURSE "--value contacts --group experience"},
    {"dunn", COURSE "--value contacts --group experience"},
    {"welch_anova", COURSE "--value score --group experience"},
    {"jonckheere", COURSE "--value score --group experience --options order=novice:intermediate:expert"},
    {"friedman", COURSE "--value rater_a,rater_b,rater_c --subject person"},
    {"effect_size", COURSE "--value score --group experience --options order=expert:novice"},
    {"tost", COURSE "--value score --group site --options margin=10"},
    {"max_t", COURSE "--value score,accuracy,contacts --group experience --options order=novice:expert"},
    {"holm", "--csv docs/statistics/tests.csv --value p"},
    {"bh", "--csv docs/statistics/tests.csv --value p"},
    {"power", "--options d=0.8,power=0.9"},
    {"wilson", COURSE "--value hit --group experience"},
    {"fisher", COURSE "--value hit --group experience --options order=expert:novice"},
    {"pearson", COURSE "--value score --x accuracy --options reliability_x=0.8"},
    {"spearman", COURSE "--value score --x logbook"},
    {"kendall", COURSE "--value score --x global"},
    {"auc", COURSE "--value score --group experience --options order=novice:expert,positive=expert"},
    {"delong", COURSE "--value score,accuracy --group experience --options order=novice:expert,positive=expert"},
    {"poisson", COURSE "--value contacts --group experience --options order=novice:expert"},
    {"negative_binomial", COURSE "--value contacts --group experience --options order=novice:expert"},
    {"kaplan_meier", COURSE "--value minutes --x reached --group experience"},
    {"log_rank", COURSE "--value minutes --x reached --group experience"},
    {"rmst", COURSE "--value minutes --x reached --group experience --options order=novice:expert,tau=12"},
    {"tobit", COURSE "--value accuracy --group site --options limit=100"},
    {"imputed", COURSE "--value after --x before --group experience --options order=novice:expert"},
    {"bootstrap", COURSE "--value contacts --group experience --options order=novice:expert,statistic=median"},
    {"icc", COURSE "--value rater_a,rater_b,rater_c"},
    {"kappa", COURSE "--value grade_a,grade_b --options weights=quadratic"},
    {"alpha", COURSE "--value q1,q2,q3,q4,q5 --options low=1,high=5"},
    {"omega", COURSE "--value q1,q2,q3,q4,q5"},
    {"bland_altman", COURSE "--value rater_a,rater_b"},
    {"g_theory", ATTEMPTS "--value score --subject person --rater case --x occasion"},
    {"grim", "--options n=25,mean=3.48"},
    {"grimmer", "--options n=25,mean=3.48,sd=1.05,low=1,high=5"},
    {"contrasting_groups", COURSE "--value score --group qualified --options competent=yes"},
    {"borderline", COURSE "--value score --x global"},
    {"angoff", "--csv docs/statistics/judges.csv --value share --subject item --rater judge"},
    {"hofstee", COURSE "--value score --options cut_low=50:55,cut_high=65:70,fail_low=0.1:0.2,fail_high=0.4:0.5"},
    {"classification", COURSE "--value score --options cut=65,reliability=0.85"},
    {"lc_cusum", ATTEMPTS "--value failed --subject person --x attempt"},
    {"cusum", ATTEMPTS "--value failed --subject person --x attempt"},
    {"proficiency", ATTEMPTS "--value hit --subject person --x attempt"},
    {"learning_curve", ATTEMPTS "--value score --subject person --x attempt --options better=higher"},
    {"decay", ATTEMPTS "--value score --subject person --x occasion --options better=higher"},
    {"mixed_model", ATTEMPTS "--value score --subject person --x attempt"},
    {"logistic_mixed", ATTEMPTS "--value hit --subject person --x attempt"},
    {"rasch", COURSE "--value item1,item2,item3,item4,item5,item6,item7,item8"},
};

#undef COURSE
#undef ATTEMPTS

}  // namespace

std::span<const ProcedureExample> procedure_examples() {
  return kExamples;
}

}  // namespace seldinger::app
