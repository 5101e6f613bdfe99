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

An operator is one clone, however many seeds it has. `--people` of novice, intermediate, expert or a group's file makes
[simulated people](simulated-people.md) instead, who overlap as people do; of learner and a file of skills it makes people
about that operator, each with streams of their own.

Filled: how people of different experience differed in published studies, with 95 % intervals; crosses: what simulated people
would have shown there; hollow: each metric of theirs at Drill 2, experts and novices
([by `seldinger surrogate effects --chart`](benchmarks/simulated-people.md)).

![Published differences between groups, and those of every metric of simulated people](benchmarks/simulated-people.svg)

The named experts pass every drill and the named novices hardly ever; people overlap: [who passes which](simulated-people.md#what-they-do-to-rules-and-thresholds).

What they see is what a person would: what each picture shows, after their reaction time; the needle outside the skin and
the marks on its shaft; of the tip no more than whether the picture shows it, and where while it does. They sign in, and
defer where INR is over 1.8 or platelets are below 50 · 10⁹/l (SIR 2019, high risk); find the plane, check the probe, note
the plan, aspirate, anaesthetise, nick; go on only while the tip is seen (jiggle, bring the probe over the needle, go back a
little, then on by 2 mm); check the aim before the organ's capsule and correct within it; out of plane put the probe 3 mm
ahead and let the tip follow; ask for a held breath; fire when the tip is seen; take the needle out and sign out. Of a patient
who breathes, skin is numbed as it lies between two breaths, a held breath is asked for before the needle goes in, waited for
(what breath moves meets a needle that waits inside), asked for again when it is lost; tissue that gave way is aimed at where
the picture shows the target. Who has less of a skill leaves out more of that. In a still case nobody does anything of it, and
attempts of the same seed are those of before.

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
