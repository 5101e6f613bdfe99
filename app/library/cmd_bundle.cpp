// case bundle, bundle export, bundle import, bundle check, bundle key, bundle trust.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/cli/key_file.h"
#include "app/cli/version.h"
#include "app/cli/words.h"
#include "app/library/keep_json.h"

namespace seldinger::app {
namespace {

int print_bundle(const Arguments& arguments, const base::Result<casedb::Bundle>& bundle) {
  if (!bundle) return refuse(bundle.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_bundle(*bundle).c_str(), stdout);
    return kDone;
  }
  std::printf("%zu case%s, %zu files, %.1f MB, schema %d, written by version %s, %s%s\n", bundle->case_ids.size(),
              bundle->case_ids.size() == 1 ? "" : "s", bundle->assets, static_cast<double>(bundle->bytes) * 1e-6,
              bundle->schema, bundle->program_version.c_str(), bundle->signing_key ? "signed by " : "unsigned",
              bundle->signing_key.value_or("").c_str());
  return kDone;
}

int write_bundle_of(const Arguments& arguments, bool every_case) {
  const std::string out = arguments.required("--out");
  std::optional<casedb::HashKey> secret_key;
  if (arguments.has("--sign")) {
    const auto key = existing_key(arguments.text("--sign"));
    if (!key) return refuse(error_of("--sign", arguments.text("--sign"), key.error()));
    secret_key = *key;
  }
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::hand_out_case); !by) return refuse(by.error());
  std::vector<std::string> case_ids;  // none: every one
  if (!every_case) case_ids.push_back(arguments.positional(0));
  const auto written = casedb::write_bundle(*library, case_ids, out, kVersion, secret_key);
  const auto outcome = written ? casedb::Outcome::done : casedb::Outcome::refused;
  try {
    if (case_ids.empty()) casedb::audit_alone(*library, casedb::Act::export_cases, {}, outcome);
    for (const std::string& case_id : case_ids)
      if (const auto row = casedb::find_case(*library, case_id))
        casedb::audit_alone(*library, casedb::Act::export_cases, {"case", row->case_id}, outcome);
  } catch (...) {
    if (written) std::filesystem::remove(out);  // nothing leaves unnoted
    throw;
  }
  return print_bundle(arguments, written);
}

int run_case_bundle(const Arguments& arguments) {
  return write_bundle_of(arguments, false);
}

int run_bundle_export(const Arguments& arguments) {
  return write_bundle_of(arguments, true);
}

int run_bundle_check(const Arguments& arguments) {
  const auto bundle = casedb::check_bundle(arguments.positional(0));
  if (!bundle) return refuse(error_of("FILE.sdbundle", arguments.positional(0), bundle.error()));
  return print_bundle(arguments, bundle);
}

int run_bundle_import(const Arguments& arguments) {
  const std::string& file = arguments.positional(0);
  const bool may_make = arguments.has("--new-library");
  if (may_make)  // a library is not made for what is refused
    if (const auto sound = casedb::check_bundle(file); !sound)
      return refuse(error_of("FILE.sdbundle", file, sound.error()));
  auto library = open_acting(arguments, may_make ? WhereNone::create : WhereNone::refuse);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::add_case); !by) return refuse(by.error());
  const auto cases = casedb::import_bundle(*library, file);
  if (!cases) return refuse(error_of("FILE.sdbundle", file, cases.error()));
  if (arguments.has("--json")) {
    std::fputs(json_of_unbundled(*cases).c_str(), stdout);
    return kDone;
  }
  std::puts(!cases->signing_key ? "unsigned: nobody vouches for what the bundle says"
            : cases->trusted_as ? ("signed by " + *cases->trusted_as).c_str()
                                : ("signed by " + *cases->signing_key + ", which is not trusted here").c_str());
  for (const std::string& case_id : cases->stored) std::printf("case %s stored\n", case_id.c_str());
  for (const std::string& case_id : cases->for_review)
    std::printf("case %s was published by its sender: it is in review here\n", case_id.c_str());
  if (cases->healed > 0) std::printf("%zu damaged files of cases here are whole again\n", cases->healed);
  for (const std::string& case_id : cases->present)
    std::printf("case %s is here already; nothing was done\n", case_id.c_str());
  return kDone;
}

int run_bundle_key(const Arguments& arguments) {
  auto key = key_from_file(arguments.positional(0));
  if (!key) return refuse(error_of("KEYFILE", arguments.positional(0), key.error()));
  const std::string public_key = casedb::public_key_of(*key);
  key->fill(std::byte{0});
  std::puts(public_key.c_str());
  return kDone;
}

int run_bundle_trust(const Arguments& arguments) {
  const std::string& what = arguments.positional(0);
  const bool list = what == "list", add = what == "add";
  if (!list && !add && what != "remove") throw UsageError("bundle trust add KEY --label NAME, list, or remove KEY");
  if (arguments.positionals() != (list ? 1U : 2U)) throw UsageError(list ? "list takes no key" : "which key?");
  const std::string label = add ? arguments.required("--label") : "";
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (!list)
    if (const auto by = acting(*library, arguments, casedb::Action::keep_library); !by) return refuse(by.error());
  if (!list) {
    const auto done = add ? casedb::add_trusted_key(*library, arguments.positional(1), label)
                          : casedb::remove_trusted_key(*library, arguments.positional(1));
    if (!done) return refuse(done.error());
    if (!arguments.has("--json")) {
      std::puts(add ? "trusted" : "no longer trusted");
      return kDone;
    }
  }
  const auto keys = casedb::list_trusted_keys(*library);
  if (arguments.has("--json"))
    std::fputs(json_of_trusted_keys(keys).c_str(), stdout);
  else
    for (const casedb::TrustedKey& key : keys) std::printf("%s  %s\n", key.public_key.c_str(), key.label.c_str());
  return kDone;
}

constexpr Option kBundleOptions[] = {kLibrary,
                                     {"--out", "FILE.sdbundle", "the file; replaced when it is there"},
                                     {"--sign", "KEYFILE", "signs it with the secret key that `bundle key` made"},
                                     kJson};

constexpr Option kImportOptions[] = {kLibrary, kNewLibrary, kJson};

constexpr Option kTrustOptions[] = {
    kLibrary, {"--label", "NAME", "add: the name shown for that key's signatures"}, kJson};

}  // namespace

Command case_bundle_command() {
  return {.name = "case bundle",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kBundleOptions,
          .acts = true,
          .summary = "Writes a case as one checked file for another library; attempts and people stay.",
          .run = &run_case_bundle};
}

Command bundle_export_command() {
  return {.name = "bundle export",
          .options = kBundleOptions,
          .acts = true,
          .summary = "Writes every case of a library as one such file.",
          .run = &run_bundle_export};
}

Command bundle_import_command() {
  return {.name = "bundle import",
          .positionals = "FILE.sdbundle",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kImportOptions,
          .acts = true,
          .summary =
              "Checks such a file and takes its cases into the library, all or none; a case that is there already "
              "stays. What its sender published is in review here.",
          .run = &run_bundle_import};
}

Command bundle_check_command() {
  return {.name = "bundle check",
          .positionals = "FILE.sdbundle",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kJsonOnly,
          .summary = "Checks such a file, every byte of it.",
          .run = &run_bundle_check};
}

Command bundle_key_command() {
  return {
      .name = "bundle key",
      .positionals = "KEYFILE",
      .min_positionals = 1,
      .max_positionals = 1,
      .summary = "Makes a secret key to sign bundles with, unless the file is there, and prints its public key.",
      .run = &run_bundle_key};
}

Command bundle_trust_command() {
  return {.name = "bundle trust",
          .positionals = "add|list|remove [KEY]",
          .min_positionals = 1,
          .max_positionals = 2,
          .options = kTrustOptions,
          .acts = true,
          .summary = "Keeps the public keys whose signatures are known in a library, each with a name.",
          .run = &run_bundle_trust};
}

}  // namespace seldinger::app
