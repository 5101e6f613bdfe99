# Redoes the numbers of a Seldinger validity report from the data beside this script, in R without packages:
#
#   Rscript redo.R [FOLDER]
#
# people.csv holds what each person has on each outcome, outcomes.csv how the plan compares them, answers.csv what was
# answered to questionnaires, ratings.csv what raters gave, related.csv outcomes beside mean ratings and stated experience,
# subgroups.csv who passed, baseline.csv what groups stated of themselves, imputed.csv what was drawn for absent people, numbers.csv what the report says. Each number that comes out otherwise is printed, then how
# many were redone and the largest difference; the exit status is 1 where one differs. The p of a permutation test that
# drew its deals and omega's interval, which is a bootstrap's, are redone with other draws, and may differ by what chance
# makes of them.

arguments <- commandArgs(trailingOnly = TRUE)
folder <- if (length(arguments) > 0) arguments[1] else "."
table_of <- function(name)
  read.csv(file.path(folder, name), colClasses = "character", na.strings = "", encoding = "UTF-8", check.names = FALSE)
people <- table_of("people.csv")
outcomes <- table_of("outcomes.csv")
answers <- table_of("answers.csv")
ratings <- table_of("ratings.csv")
related <- table_of("related.csv")
subgroups <- table_of("subgroups.csv")
baseline <- table_of("baseline.csv")
imputed <- table_of("imputed.csv")
numbers <- table_of("numbers.csv")
for (name in c("value", "last_but_one", "last", "odd", "even")) people[[name]] <- as.numeric(people[[name]])
for (name in c("failure_value", "cut")) outcomes[[name]] <- as.numeric(outcomes[[name]])
numbers$value <- as.numeric(numbers$value)
answers$score <- as.numeric(answers$score)
for (name in c("each", "replay", "rater", "score")) ratings[[name]] <- as.numeric(ratings[[name]])
for (name in c("value", "beside")) related[[name]] <- as.numeric(related[[name]])
subgroups$passed <- as.numeric(subgroups$passed)
baseline$value <- as.numeric(baseline$value)
for (name in c("draw", "place", "value")) imputed[[name]] <- as.numeric(imputed[[name]])
alpha <- 0.05   # of "would have been found"
power <- 0.8
draws <- 10000  # of a permutation test whose deals are more
resamples <- 1000  # of persons, for omega's interval

# --- what stands in the place of those without a value ----------------------------------------------------------------
stand_in <- function(stead, outcome, low, high) {
  at_high_end <- (stead == "worst") == (outcome$better == "lower")
  if (outcome$test == "welch") {
    if (stead == "worst" && !is.na(outcome$failure_value)) return(outcome$failure_value)
    return(if (at_high_end) high else low)
  }
  step <- max(high - low, 1e-3 * max(abs(low), abs(high), 1))
  if (at_high_end) high + step else low - step
}

# The values of both groups; `failed`, `first` and `second` (those who are absent there) are worst, best or left_out.
values_by <- function(own, outcome, failed, first, second) {
  present <- own$value[own$standing == "value"]
  low <- if (length(present)) min(present) else 0
  high <- if (length(present)) max(present) else 0
  value <- own$value
  for (i in seq_len(nrow(own))) {
    if (own$standing[i] == "value") next
    stead <- if (own$standing[i] != "absent") failed else if (own$group[i] == outcome$first) first else second
    value[i] <- if (stead == "left_out") NA else stand_in(stead, outcome, low, high)
  }
  list(a = value[own$group == outcome$first & !is.na(value)], b = value[own$group == outcome$second & !is.na(value)])
}

# --- tests ------------------------------------------------------------------------------------------------------------
of_welch <- function(a, b) {
  test <- t.test(a, b)
  df <- unname(test$parameter)
  critical <- qt(1 - alpha / 2, df)
  off <- function(errors) pt(critical, df, errors, lower.tail = FALSE) + pt(-critical, df, errors) - power
  errors <- uniroot(off, c(0.5, 20 + 2 * critical), tol = 1e-13)$root
  list(estimate = mean(a) - mean(b), low = test$conf.int[1], high = test$conf.int[2], p = test$p.value,
       detectable = errors * test$stderr)
}

detectable_probability <- function(n1, n2)
  0.5 + (qnorm(1 - alpha / 2) + qnorm(power)) * sqrt((n1 + n2) / (12 * n1 * n2))

# Exact given the ties: how many ways to deal the doubled ranks have each sum (Streitberg and Roehmel 1987).
of_mann_whitney <- function(a, b) {
  n1 <- length(a); n2 <- length(b); n <- n1 + n2
  ranks <- rank(c(a, b))
  u <- sum(ranks[1:n1]) - n1 * (n1 + 1) / 2
  if (n <= 100) {
    scores <- as.integer(round(2 * ranks))
    ways <- matrix(0, n1 + 1, sum(scores) + 1)
    ways[1, 1] <- 1
    for (score in scores)
      for (k in n1:1) {
        here <- seq_len(ncol(ways) - score)
        ways[k + 1, here + score] <- ways[k + 1, here + score] + ways[k, here]
      }
    chances <- ways[n1 + 1, ] / sum(ways[n1 + 1, ])
    off <- abs(seq_along(chances) - 1 - n1 * (n + 1))
    p <- sum(chances[off >= off[sum(scores[1:n1]) + 1]])
  } else {
    p <- wilcox.test(a, b, exact = FALSE)$p.value
  }
  differences <- sort(outer(a, b, "-"))
  k <- if (n <= 100) qwilcox(0.025, n1, n2) else
    max(0, floor(n1 * n2 / 2 - qnorm(0.975) * sqrt(n1 * n2 * (n + 1) / 12)))
  list(estimate = median(differences), low = if (k > 0) differences[k] else NA,
       high = if (k > 0) differences[n1 * n2 + 1 - k] else NA, p = min(1, p), cliff_delta = 2 * u / (n1 * n2) - 1,
       detectable = detectable_probability(n1, n2))
}

superiority <- function(a, b) {
  n1 <- length(a); n2 <- length(b)
  both <- rank(c(a, b))
  place_a <- both[1:n1] - rank(a)
  place_b <- both[n1 + 1:n2] - rank(b)
  part1 <- var(place_a) / (n1 * n2^2)
  part2 <- var(place_b) / (n2 * n1^2)
  list(estimate = mean(place_a) / n2, error = sqrt(part1 + part2),
       df = (part1 + part2)^2 / (part1^2 / (n1 - 1) + part2^2 / (n2 - 1)))
}

extremeness <- function(found) {
  off <- abs(found$estimate - 0.5)
  if (found$error > 0) off / found$error else if (off > 0) Inf else 0
}

of_brunner_munzel <- function(a, b) {
  n1 <- length(a); n2 <- length(b); n <- n1 + n2
  found <- superiority(a, b)
  all <- c(a, b)
  drawn <- FALSE
  if (min(n1, n2) < 15 || !(found$error > 0)) {
    least <- extremeness(found) * (1 - 1e-12)
    as_extreme <- function(firsts) extremeness(superiority(all[firsts], all[-firsts])) >= least
    drawn <- choose(n, n1) > draws
    if (drawn) {
      set.seed(1)
      p <- (sum(replicate(draws, as_extreme(sample.int(n, n1)))) + 1) / (draws + 1)
    } else {
      p <- mean(combn(n, n1, as_extreme))
    }
  } else {
    p <- 2 * pt(extremeness(found), found$df, lower.tail = FALSE)
  }
  estimate <- found$estimate
  if (found$error > 0) {
    wide <- qt(0.975, found$df) * found$error / (estimate * (1 - estimate))
    ends <- plogis(qlogis(estimate) + c(-wide, wide))
  } else {  # Newcombe's method 5
    z <- qnorm(0.975); m <- n / 2 - 1
    least <- uniroot(function(theta) (1 - theta) - z^2 * theta * (1 + m * ((1 - theta) / (2 - theta) + theta / (1 + theta))) /
                       (n1 * n2), c(0, 1), tol = 1e-13)$root
    ends <- if (estimate == 1) c(least, 1) else c(0, 1 - least)
  }
  list(estimate = estimate, low = ends[1], high = ends[2], p = p, cliff_delta = 2 * estimate - 1,
       detectable = detectable_probability(n1, n2), drawn = drawn)
}

compared <- function(values, outcome) {
  test <- switch(outcome$test, welch = of_welch, mann_whitney = of_mann_whitney, brunner_munzel = of_brunner_munzel)
  c(list(n = length(values$a) + length(values$b)), test(values$a, values$b))
}

# --- the same under other rules ---------------------------------------------------------------------------------------
by_rule <- function(rule, own, outcome, shift) {
  absent <- if (outcome$absent == "failure") "worst" else "left_out"
  if (rule == "present") return(values_by(own, outcome, "left_out", "left_out", "left_out"))
  if (rule == "best_in_first") return(values_by(own, outcome, "worst", "best", "worst"))
  if (rule == "worst_in_first") return(values_by(own, outcome, "worst", "worst", "best"))
  if (rule == "per_protocol") own <- own[own$every_visit == "1", ]
  if (rule == "tipping") {
    plans <- by_rule("plan", own, outcome)
    off <- switch(outcome$test, welch = mean(plans$a) - mean(plans$b), mann_whitney = median(outer(plans$a, plans$b, "-")),
                  brunner_munzel = superiority(plans$a, plans$b)$estimate - 0.5)
    larger <- off > 0
    first_is_better <- larger == (outcome$better == "higher")
    worse <- if (outcome$better == "lower") 1 else -1
    middle <- function(group) median(own$value[own$group == group & own$standing == "value"])
    for (i in which(own$standing == "absent")) {
      first <- own$group[i] == outcome$first
      own$value[i] <- middle(own$group[i]) + (if (first == first_is_better) worse else -worse) * shift
    }
    # Only now, so that medians are of those who were there.
    own$standing[own$standing == "absent"] <- "value"
  }
  values_by(own, outcome, "worst", absent, absent)
}

# --- agreement and decisions ------------------------------------------------------------------------------------------
# ICC(2,1) of two columns with its interval (McGraw and Wong 1996).
agreement <- function(scores) {
  n <- nrow(scores); k <- ncol(scores)
  subjects <- rowMeans(scores); raters <- colMeans(scores); middle <- mean(scores)
  ms_s <- k * sum((subjects - middle)^2) / (n - 1)
  ms_r <- n * sum((raters - middle)^2) / (k - 1)
  ms_e <- sum((scores - outer(subjects, raters, "+") + middle)^2) / ((n - 1) * (k - 1))
  icc <- (ms_s - ms_e) / (ms_s + (k - 1) * ms_e + k * (ms_r - ms_e) / n)
  a <- k * icc * ms_r / ms_e; b <- n * (1 + (k - 1) * icc) - k * icc
  df <- (k - 1) * (n - 1) * (a + b)^2 / ((n - 1) * a^2 + b^2)
  over <- qf(0.975, n - 1, df); under <- qf(0.975, df, n - 1)
  rest <- k * ms_r + (k * n - k - n) * ms_e
  sem <- sd(as.vector(scores)) * sqrt(1 - icc)
  list(agreement_n = n, agreement_icc = icc, agreement_icc_low = n * (ms_s - over * ms_e) / (over * rest + n * ms_s),
       agreement_icc_high = n * (under * ms_s - ms_e) / (rest + n * under * ms_s), agreement_sem = sem,
       agreement_mdc95 = 1.96 * sqrt(2) * sem)
}

wilson <- function(x, n) {
  z <- qnorm(0.975); p <- x / n
  (p + z^2 / (2 * n) + c(-1, 1) * z * sqrt(p * (1 - p) / n + z^2 / (4 * n^2))) / (1 + z^2 / n)
}

both_below <- function(h, k, rho)
  integrate(function(x) dnorm(x) * pnorm((k - rho * x) / sqrt(1 - rho^2)), -Inf, h, rel.tol = 1e-11)$value

# Two equivalent tests with normal scores (Peng and Subkoviak 1980).
decisions <- function(scores, cut, reliability, higher) {
  side <- if (higher) 1 else -1
  observed <- side * (cut - mean(scores)) / sd(scores); truly <- observed / sqrt(reliability)
  fail <- pnorm(observed)
  rightly <- both_below(observed, truly, sqrt(reliability))
  list(alike = 1 - 2 * (fail - both_below(observed, observed, reliability)),
       false_pass = max(0, pnorm(truly) - rightly), false_fail = max(0, fail - rightly))
}

# --- absent people's values, drawn ------------------------------------------------------------------------------------
# Rubin's rules with Barnard and Rubin's degrees of freedom (Biometrika 86, 1999).
of_imputed <- function(own, outcome) {
  own <- rbind(own[own$group == outcome$first, ], own[own$group == outcome$second, ])
  absent <- which(own$standing == "absent")
  own$value[own$standing %in% c("failure", "censored")] <- outcome$failure_value
  drawn <- imputed[imputed$outcome == outcome$outcome, ]
  by_draw <- lapply(split(drawn, drawn$draw), function(one) {
    own$value[absent[one$place]] <- one$value
    test <- t.test(own$value[own$group == outcome$first], own$value[own$group == outcome$second])
    c(estimate = unname(test$estimate[1] - test$estimate[2]), variance = test$stderr^2, df = unname(test$parameter))
  })
  all <- do.call(rbind, by_draw)
  m <- nrow(all)
  within <- mean(all[, "variance"]); between <- var(all[, "estimate"]); total <- within + (1 + 1 / m) * between
  lost <- (total - within) / total; complete <- mean(all[, "df"])
  df <- 1 / (lost^2 / (m - 1) + (complete + 3) / ((complete + 1) * complete * (1 - lost)))
  estimate <- mean(all[, "estimate"])
  list(n = nrow(own), estimate = estimate, low = estimate - qt(0.975, df) * sqrt(total),
       high = estimate + qt(0.975, df) * sqrt(total), p = 2 * pt(-abs(estimate) / sqrt(total), df))
}

# --- questionnaires, raters, ratings beside outcomes ------------------------------------------------------------------
# One factor by maximum likelihood; a small factr, for factanal stops early.
omega_of <- function(x) {
  found <- tryCatch(factanal(x, 1, control = list(opt = list(factr = 1, pgtol = 0, maxit = 5000))), error = function(e) NULL)
  if (is.null(found)) return(NA)
  common <- sum(found$loadings)^2
  common / (common + sum(found$uniquenesses))
}

of_scale <- function(own, asked) {
  x <- tapply(own$score, list(own$respondent, own$item), identity)
  x <- x[complete.cases(x), , drop = FALSE]
  n <- nrow(x)
  found <- list(respondents = n)
  if (n < 2) return(found)
  x <- x[, apply(x, 2, var) > 0, drop = FALSE]
  k <- ncol(x)
  if ("alpha" %in% asked) {
    alpha <- k / (k - 1) * (1 - sum(apply(x, 2, var)) / var(rowSums(x)))
    ends <- 1 - (1 - alpha) * qf(c(0.975, 0.025), n - 1, (n - 1) * (k - 1))  # Feldt
    found <- c(found, list(alpha = alpha, alpha_low = ends[1], alpha_high = ends[2]))
  }
  if ("omega" %in% asked) found$omega <- omega_of(x)
  if ("omega_low" %in% asked) {
    set.seed(1)
    logits <- qlogis(replicate(resamples, suppressWarnings(omega_of(x[sample.int(n, n, replace = TRUE), ]))))
    wide <- qnorm(0.975) * sd(logits[is.finite(logits)])
    found$omega_low <- plogis(qlogis(found$omega) - wide)
    found$omega_high <- plogis(qlogis(found$omega) + wide)
    # A standard deviation of so many draws is off by chance, here as in the report; five standard errors of that.
    share <- 5 * sqrt(2 / (2 * resamples))
    reach <- function(end, far) abs(plogis(qlogis(found$omega) + far * wide * (1 + share)) - end)
    found$chance <- list(omega_low = reach(found$omega_low, -1), omega_high = reach(found$omega_high, 1))
  }
  found
}

# ICC(1) and ICC(1,k): the first ratings of each replay, raters in their order (Shrout and Fleiss 1979).
of_round <- function(own) {
  each <- own$each[1]
  own <- own[order(own$replay, own$rater), ]
  whole <- Filter(function(scores) length(scores) >= each, split(own$score, own$replay))
  scores <- do.call(rbind, lapply(whole, function(one) one[seq_len(each)]))
  found <- list(ratings = nrow(own))
  if (is.null(scores) || nrow(scores) < 2 || each < 2) return(found)
  n <- nrow(scores)
  between <- each * var(rowMeans(scores)); within <- mean(apply(scores, 1, var))
  f <- between / within
  ends <- f / c(qf(0.975, n - 1, n * (each - 1)), qf(0.025, n - 1, n * (each - 1)))
  one <- function(f) (f - 1) / (f + each - 1)
  c(found, list(icc_one = one(f), icc_one_low = one(ends[1]), icc_one_high = one(ends[2]), icc_mean = 1 - 1 / f,
                icc_mean_low = 1 - 1 / ends[1], icc_mean_high = 1 - 1 / ends[2]))
}

# Bonett and Wright's interval (2000); corrected by Spearman (1904), the outcome's halves stepped up by Spearman and Brown.
of_related <- function(own, outcome) {
  n <- nrow(own)
  found <- list(related_people = n)
  halves <- people[people$outcome == outcome & !is.na(people$odd), ]
  if (nrow(halves) > 2) {
    r <- suppressWarnings(cor(rank(halves$odd), rank(halves$even)))
    if (!is.na(r) && r > 0) found$reliability <- 2 * r / (1 + r)
  }
  if (n < 2) return(found)
  rho <- suppressWarnings(cor(rank(own$value), rank(own$beside)))
  ends <- tanh(atanh(rho) + c(-1, 1) * qnorm(0.975) * sqrt((1 + rho^2 / 2) / (n - 3)))
  root <- if (is.na(own$form[1])) NA else sqrt(found$reliability * of_round(ratings[ratings$of == own$form[1], ])$icc_mean)
  c(found, list(rho = rho, rho_low = ends[1], rho_high = ends[2]),
    if (length(root) == 1) list(corrected = rho / root, corrected_low = ends[1] / root, corrected_high = ends[2] / root))
}

# Wilson's interval of a share, and Newcombe's of its difference from the first subgroup's (1998, method 10).
of_subgroup <- function(own, first) {
  n <- nrow(own); n1 <- nrow(first)
  p <- mean(own$passed); p1 <- mean(first$passed)
  ends <- wilson(sum(own$passed), n); ends1 <- wilson(sum(first$passed), n1)
  list(passed = sum(own$passed), persons = n, share_low = ends[1], share_high = ends[2],
       difference_low = p - p1 - sqrt((p - ends[1])^2 + (ends1[2] - p1)^2),
       difference_high = p - p1 + sqrt((ends[2] - p)^2 + (p1 - ends1[1])^2))
}

# --- all of it --------------------------------------------------------------------------------------------------------
of_group <- function(own, group, which) {
  here <- own[own$group == group, ]
  present <- here$value[here$standing == "value"]
  quarters <- if (length(present)) unname(quantile(present, c(0.5, 0.25, 0.75))) else rep(NA, 3)
  setNames(list(sum(here$standing != "absent"), sum(here$standing %in% c("failure", "censored")),
                sum(here$standing == "absent"), quarters[1], quarters[2], quarters[3]),
           paste0(which, c("_n", "_failed", "_absent", "_median", "_low_quartile", "_high_quartile")))
}

redone <- list()  # by outcome and rule
for (i in seq_len(nrow(outcomes))) {
  outcome <- as.list(outcomes[i, ])
  own <- people[people$outcome == outcome$outcome, ]
  said <- numbers[numbers$outcome == outcome$outcome, ]
  for (rule in unique(said$rule)) {
    asked <- said$number[said$rule == rule]
    shift <- said$value[said$rule == rule & said$number == "shift"]
    found <- list(shift = shift)
    if (rule == "imputed") found <- c(found, of_imputed(own, outcome))
    else if ("estimate" %in% asked) found <- c(found, compared(by_rule(rule, own, outcome, shift), outcome))
    if (rule == "plan") {
      found <- c(found, of_group(own, outcome$first, "first"), of_group(own, outcome$second, "second"))
      twice <- as.matrix(own[!is.na(own$last_but_one), c("last_but_one", "last")])
      if ("agreement_n" %in% asked) found <- c(found, agreement(twice))
      if ("first_pass" %in% asked) {
        higher <- outcome$cut_higher_is_better == "1"
        for (which in c("first", "second")) {
          here <- own[own$group == outcome[[which]] & own$standing != "absent", ]
          passed <- sum(here$standing == "value" & (if (higher) here$value >= outcome$cut else here$value <= outcome$cut),
                        na.rm = TRUE)
          ends <- wilson(passed, nrow(here))
          found <- c(found, setNames(list(passed, ends[1], ends[2]), paste0(which, c("_pass", "_pass_low", "_pass_high"))))
        }
        if ("alike" %in% asked)
          found <- c(found, decisions(own$value[own$standing == "value"], outcome$cut, found$agreement_icc, higher))
      }
    }
    redone[[paste(outcome$outcome, rule)]] <- found
  }
}

for (which in unique(numbers$outcome[numbers$rule %in% c("answers", "ratings", "related", "subgroups", "baseline")])) {
  number <- strsplit(which, " ")[[1]]
  said <- numbers[numbers$outcome == which, ]
  redone[[paste(which, said$rule[1])]] <- switch(said$rule[1],
    answers = of_scale(answers[answers$scale == number[2], ], said$number),
    ratings = of_round(ratings[ratings$of == which, ]),
    related = of_related(related[related$outcome == number[2] & related$other == number[4], ], number[2]),
    baseline = {
      stated <- baseline$value[baseline$group == number[2] & baseline$fact == number[3]]
      quarters <- unname(quantile(stated, c(0.5, 0.25, 0.75)))
      list(stated = length(stated), median = quarters[1], low_quartile = quarters[2], high_quartile = quarters[3])
    },
    subgroups = {
      here <- subgroups[subgroups$outcome == number[2] & subgroups$by == number[4], ]
      of_subgroup(here[here$subgroup == number[6], ], here[here$subgroup == "1", ])
    })
}

# Holm's step-down: what could not be tested counts in the family.
primary <- outcomes$outcome[outcomes$primary == "1"]
tested <- vapply(primary, function(which) {
  p <- redone[[paste(which, "plan")]]$p
  if (is.null(p) || outcomes$refused[outcomes$outcome == which] == "1") NA_real_ else p
}, numeric(1))
holm <- p.adjust(tested, "holm", n = length(tested))
any_drawn <- FALSE
for (which in primary) {
  redone[[paste(which, "plan")]]$p_holm <- unname(holm[which])
  any_drawn <- any_drawn || isTRUE(redone[[paste(which, "plan")]]$drawn)
}

worst <- 0
differing <- 0
for (i in seq_len(nrow(numbers))) {
  number <- numbers[i, ]
  found <- redone[[paste(number$outcome, number$rule)]]
  here <- found[[number$number]]
  by_chance <- (number$number == "p" && isTRUE(found$drawn)) || (number$number == "p_holm" && any_drawn)
  allowed <- 1e-7
  if (by_chance) {
    p <- max(number$value, 2 / draws)
    allowed <- (if (number$number == "p_holm") length(primary) else 1) * 5 * sqrt(2 * p * (1 - min(p, 0.5)) / draws)
  }
  if (number$number %in% names(found$chance)) {
    by_chance <- TRUE
    allowed <- found$chance[[number$number]]
  }
  off <- if (is.null(here) || is.na(here)) Inf else abs(here - number$value)
  if (!by_chance) off <- off / max(1, abs(number$value))
  if (!by_chance) worst <- max(worst, off)
  if (!(off <= allowed)) {
    differing <- differing + 1
    cat("differs: outcome", number$outcome, number$rule, number$number, "report", format(number$value, digits = 15),
        "here", if (is.null(here)) "nothing" else format(here, digits = 15), "\n")
  }
}
cat(nrow(numbers), "numbers redone,", differing, "differ; the largest difference of those that chance has no part in:",
    format(worst, digits = 3), "\n")
if (differing > 0) quit(status = 1)
