// docs/operators.md.
#include <cstdio>

#include "assessment/operators/profile.h"

namespace seldinger::assessment {
namespace {

constexpr const char* kBefore = R"(# Simulated operators

Made by `seldinger help --operators > docs/operators.md`. Simulated operators test the software. What they show says nothing
about people: no standard is set by them, no validity shown. Every attempt of theirs says `"synthetic": true` in answers and
"Simulated …" on pages and lists; none can be called `person`, which is what attempts of people are stored under.

```
seldinger simulate --library DIR --case ID --operator expert --seed 1 --count 10          ten attempts of one expert
seldinger simulate --library DIR --case ID --operator novice --people 12 --seed 1         twelve simulated people
seldinger simulate --library DIR --case ID --operator learner --people 5 --count 30       five learning curves
seldinger simulate --library DIR --case ID --operator FILE.json                           one of your own
```

An operator is one clone, however many seeds it has. An attempt keeps the seed that was asked for; what the hands draw from
is a hash of the seed and the operator's name, so attempts of two operators with the same seed are independent. `--people`
of novice, intermediate, expert or a group's file makes [simulated people](simulated-people.md) instead, who overlap as
people do; of learner and a file of skills it makes people about that operator, each with streams of their own.

Filled: how people of different experience differed in published studies, with 95 % intervals; crosses: what simulated people
would have shown there; hollow: each metric of theirs at Drill 2, experts and novices
([by `seldinger surrogate effects --chart`](benchmarks/simulated-people.md)).

![Published differences between groups, and those of every metric of simulated people](benchmarks/simulated-people.svg)

Blue: how the first attempts of simulated people of each level spread; red: what was published of people at phantoms and
simulators, mean ± SD or median and quartiles, each with its source, of the same surrogate
([by `seldinger surrogate distributions --chart`](benchmarks/simulated-distributions.md)):

![Simulated novices, intermediates and experts in twelve metrics, and published distributions below them](benchmarks/simulated-distributions.svg)

Of twelve published distributions with a spread, simulated people of the nearest level lie in that of four: two of the
whole time, one of the distance to the target, one of withdrawals. They take longer over the whole (medians 85 to 90 s; published medians 29 to 38 s, means 46
and 136 s), go a sixth to an eighth of the way in tissue that residents went in a model of the spine and sweep a twentieth or less
of their area, and hit at the first pass in 28 to 34 % where 76 to 100 % was published. The tasks are others (a spine, a vein, a
breast), and which level is nearest is our judgement, so this shows what differs, not why. One study of those read gives the spread of
advanced users (28.5 s, 24 to 40; simulated experts 84.9 s), none that of what the picture showed: sight is held against nothing.

### Beside what was published

Of 26 published figures 19 have a counterpart here; the command says of each whether it lies within .15 of the published value or
in its 95 % interval. All eleven figures used for the fit lie within; of the eight kept out, three do:

| kept out of the fit | published | simulated | off by | within |
|---|---|---|---|---|
| touch was accurate (Vidal 2008, table 6.2), d | 0.11 (-1.11 to 1.33) | 0.55 | 0.44 | yes |
| insertion through skin is realistic, d | 0.35 (-0.87 to 1.57) | 0.55 | 0.20 | yes |
| insertion through tissues is realistic, d | 0.17 (-1.05 to 1.39) | 0.52 | 0.35 | yes |
| level of realism, d | -0.31 (-1.54 to 0.91) | 1.65 | 1.96, of the interval 0.74 | no |
| potential tissue damage with training (Keri 2015), ratio | 0.31 | 0.83 | 0.52 | no |
| path inefficiency after practice (Xia 2018), ratio | 0.36 | 0.96 | 0.60 | no |
| needle's path after practice (Xia 2018), ratio | 0.71 | 0.95 | 0.24 | no |
| first pass (BMC Med. Educ. 2024), share of novices | 0.81 | 0.28 | 0.53 | no |

Without an interval the bound is .15. Why the five do not, by the means that the command tells (surrogate), and by whole attempts of 500
novices and 500 experts whom the surrogate does not know:

- Level of realism: table 6.3 of the same thesis, which people answer by, says 1.79 where table 6.2 says -0.31. No one group can show both.
- What is swept: practice of twenty attempts brings novices 0.68 of the 1.2 standard deviations that experts are ahead; even
  experts sweep 0.69 of novices' area (0.67 of whole attempts), so no practice here comes to 0.31.
- Inefficiency: who draws the needle back goes some three times as far in tissue (inefficiency of novices 259 % with, 10 % without), and experts
  do so as often as novices (41 and 42 times in a hundred whole attempts): who sees more misses corrects more. Experts' is
  0.90 of novices' (0.79 of whole attempts).
- The needle's path: experts' is 0.95 of novices' (0.85 of whole attempts). Of 650 mm most lies outside the body; which cannot be so of the
  published 58 mm.
- First pass: a partial withdrawal rules it out here, and more than three in ten have one. Hit with one puncture, whatever is drawn back,
  novices do in 51 % of whole attempts and experts in 81 %; the published 81 % are of novices at another simulator.

None of these is fitted. A steeper practice, or fewer corrections by the able, would be a new model of people: what was kept out
would then be fitted, and predict nothing.

The named experts pass every drill and the named novices hardly ever; people overlap: [who passes which](simulated-people.md#what-they-do-to-rules-and-thresholds).

What they see is what a person would: what each picture shows, after their reaction time; the needle outside the skin and
the marks on its shaft; of the tip no more than whether the picture shows it, and where while it does. They sign in, and
defer where INR is over 1.8 or platelets are below 50 · 10⁹/l (SIR 2019, high risk); find the plane, check the probe, note
the plan, aspirate, anaesthetise, nick; go on only while the tip is seen (jiggle, bring the probe over the needle, go back a
little, then on by 2 mm); check the aim before the organ's capsule and correct within it; out of plane put the probe 3 mm
ahead and let the tip follow; ask for a held breath; fire when the tip is seen; take the needle out and sign out. Of a patient
who breathes, skin is numbed as it lies between two breaths, a held breath is asked for before the needle goes in, waited for
(what breath moves meets a needle that waits inside), asked for again when it is lost; tissue that gave way is aimed at where
the picture shows the target. Who has less of a skill leaves out more of that. In a still case nobody does any of this.

## A file of one's own

A JSON object with any of these fields; the rest is as of the group in `like` (default expert).

| field | what |
|---|---|
| `name` | up to 64 bytes; default custom |
| `like` | novice, intermediate, expert or learner |
| `person_spread` | 1 σ of the natural logarithm of a person's skills about the profile's, with `--people`; default 0.2 |
| `learning_rate` | per attempt; 0 (default): nothing is learned |
| `learning_law` | exponential (default): exp(−rate · n) of the gap is left after n attempts (Heathcote, Brown and Mewhort 2000); power: (1 + n)^−rate (Newell and Rosenbloom 1981) |
| `attempts_before` | n at the first attempt; default 0 |
| `learns_towards` | the group whose skills are at the end of the curve; default expert |

A learner is a novice with a rate of 0.15. With `--count K` attempt i is the i-th of the person; skills are planted, so what
metrics find can be held against them.

## Skills

)";

}  // namespace

std::string operators_markdown() {
  std::string text = kBefore;
  text += "| field | unit | range | novice | intermediate | expert | what |\n|---|---|---|---|---|---|---|\n";
  for (const SkillField& field : skill_fields()) {
    char line[400];
    std::snprintf(line, sizeof line, "| `%s` | %s | %g–%g | %g | %g | %g | %s%s |\n", field.name, field.unit,
                  field.min, field.max, field.novice, field.intermediate, field.expert, field.about,
                  field.personal ? "" : " (the same in all people)");
    text += line;
  }
  return text;
}

}  // namespace seldinger::assessment
