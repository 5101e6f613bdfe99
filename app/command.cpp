#include "app/command.h"

#include <algorithm>
#include <cstdio>
#include <string>

namespace seldinger::app {
namespace {

constexpr Option kLibrary{"--library", "DIR", "the library's folder"};
constexpr Option kJson{"--json", nullptr, "one JSON document on standard output, nothing else"};

constexpr Option kHelpOptions[] = {
    {"--metrics", nullptr, "print the table of metrics (docs/metrics.md)"},
    {"--steps", nullptr, "print the table of a puncture's steps (docs/steps.md)"},
    {"--operators", nullptr, "print what simulated operators are and can (docs/operators.md)"},
    {"--commands", nullptr, "print the table of commands (docs/commands.md)"},
    {"--routes", nullptr, "print the table of web routes (docs/routes.md)"},
    {"--attributes", nullptr, "print what of a source enters a case (docs/attributes.md)"}};
constexpr Option kImportOptions[] = {
    kLibrary,
    {"--title", "TEXT", "the case's title; never taken from the source"},
    {"--series", "UID|N", "which series, when the folder holds several"},
    {"--modality", "mpr|xray|ultrasound", "what the case is practised with; default mpr"},
    {"--position", "supine|prone|lateral_left|lateral_right", "how the patient lies; default supine"},
    {"--face", "refuse|crop|deface",
     "a volume with a face: default refuse; crop keeps what is below the chin; deface takes the face's front away"},
    {"--denoise", nullptr, "takes noise out of a noisy CT, edges kept (docs/decisions/0021)"},
    {"--no-burned-in-text", nullptr, "you looked through the slices and saw no text in them"},
    {"--by", "NAME", "whose account confirms that: a mentor's, director's or admin's"},
    kJson};
constexpr Option kConfirmOptions[] = {
    kLibrary,
    {"--no-burned-in-text", nullptr, "you looked through the slices and saw no text in them"},
    {"--by", "NAME", "whose account confirms that: a mentor's, director's or admin's"}};
constexpr Option kDeidentifyOptions[] = {
    {"--key", "FILE",
     "keeps UIDs consistent with other runs; made when there is none. Whoever has it can tell them apart"},
    kJson};
constexpr Option kSampleOptions[] = {
    kLibrary, {"--lps", "X,Y,Z", "a point in mm, LPS; may be given many times", true}, kJson};
constexpr Option kLibraryJson[] = {kLibrary, kJson};
constexpr Option kJsonOnly[] = {kJson};
constexpr Option kLibraryOnly[] = {kLibrary};
constexpr Option kLesionOptions[] = {
    kLibrary,
    {"--center-mm", "X,Y,Z", "centre, LPS"},
    {"--radius-mm", "R", "of a sphere, or the mean one of an irregular lesion"},
    {"--radii-mm", "A,B,C", "an ellipsoid's, along LPS"},
    {"--irregular", "SHARE", "standard deviation of the radius, as a share of it: 0 to 0.3"},
    {"--seed", "N", "which irregular one; default 1"},
    {"--hu", "H", "its HU"},
    {"--contrast-hu", "D", "in place of --hu: added to the tissue there"},
    {"--edge-mm", "W", "width of its edge, from all to nothing; default 0"},
    {"--remove", "LESION", "takes one away again"},
    kJson};
constexpr Option kStructureOptions[] = {
    kLibrary,
    {"--name", "TEXT", "what it is called"},
    {"--rule", "advisory|major|critical|must_cross|organ|target", "what a needle in it means"},
    {"--class", "TISSUE", "all voxels of the case's tissue class"},
    {"--label", "NAME|N", "a label of the case's label maps"},
    {"--center-mm", "X,Y,Z", "drawn: a sphere or an ellipsoid"},
    {"--radius-mm", "R", "drawn: of a sphere or a tube"},
    {"--radii-mm", "A,B,C", "drawn: of an ellipsoid, along LPS"},
    {"--tube", "X,Y,Z", "drawn: a point of a tube's middle line; give them in order", true},
    {"--tissue", "TISSUE", "drawn, or a label: the tissue class it has in every picture and to the hand"},
    {"--hu", "H|as_ct",
     "drawn: what CT shows of it, as_ct: what is there; default what is typical of its class "
     "(docs/decisions/0018)"},
    {"--remove", "NAME", "takes one away again"},
    kJson};
constexpr Option kLabelOptions[] = {kLibrary, {"--name", "N=TEXT", "what label N is called", true}, kJson};
constexpr Option kSettingOptions[] = {
    kLibrary,
    {"--title", "TEXT", "the case's title"},
    {"--modality", "mpr|xray|ultrasound", "what it is practised with"},
    {"--also", "mpr|xray|ultrasound|none", "what it may be practised with too; none: nothing else", true},
    {"--subject", "patient|phantom", "phantom: a block to practise on; nothing is asked around a patient"},
    {"--position", "supine|prone|lateral_left|lateral_right", "how the patient lies"},
    {"--approach", "in_plane|out_of_plane", "of needle to picture"},
    {"--instrument", "access|core", "access: the tip decides; core: the fired notch"},
    {"--gauge", "G", "16 to 25"},
    {"--length-mm", "L", "the needle's"},
    {"--throw-mm", "T", "core: the way the tip goes when fired"},
    {"--notch-mm", "N", "core: length of the sample notch"},
    {"--dead-tip-mm", "D", "core: from the notch's end to the tip"},
    {"--inr", "X", "what the laboratory found"},
    {"--platelets", "X", "per nl (10⁹/l)"},
    {"--allergy", "TEXT", "told at the sign-in"},
    {"--indication", "TEXT", "why"},
    {"--decision", "proceed|defer", "what is right"},
    {"--breath-depth", "SHARE", "of a quiet breath, 16 mm of liver; default 0: none is shown"},
    {"--breath-period-s", "S", "from breath to breath; default 4"},
    {"--breath-irregularity", "SHARE", "standard deviation of its period and depth; default 0.1"},
    {"--tissue", "still|yields", "to probe and needle; default still"},
    {"--entry-mm", "X,Y,Z", "the planned entry"},
    {"--difficulty", "easy|moderate|hard", "how hard it is"},
    {"--time-limit-s", "S", "an attempt ends then"},
    {"--attempt-limit", "N", "so many a trainee"},
    {"--pass", "METRIC>=VALUE", "a criterion: <=, >= or =; with --critical it makes the whole rule anew", true},
    {"--critical", "METRIC=VALUE", "a criterion that must not be missed whatever else is good", true},
    {"--rule", "FILE.json", "the rule from a file"}};
constexpr Option kByOption{"--by", "NAME", "the account that decides"};
constexpr Option kNoteOption{"--note", "TEXT", "one line kept with the decision"};
constexpr Option kReviewOptions[] = {kLibrary,
                                     kByOption,
                                     {"--approve", nullptr, "a second person's word"},
                                     {"--return", nullptr, "back to draft"},
                                     kNoteOption};
constexpr Option kPublishOptions[] = {
    kLibrary, kByOption, {"--own-cohort", nullptr, "unreviewed, to the mentor's own cohort only"}, kNoteOption};
constexpr Option kRetireOptions[] = {kLibrary, kByOption, kNoteOption};
constexpr Option kVersionOptions[] = {kLibrary, kByOption, kJson};
constexpr Option kBundleOptions[] = {
    kLibrary, {"--out", "FILE.sdbundle", "the file; replaced when it is there"}, kJson};
constexpr Option kCheckOptions[] = {
    kLibrary,
    {"--repair", nullptr, "remove what is nobody's: files that no row names, temporary files without a writer"},
    kJson};
constexpr Option kRenderOptions[] = {
    {"--out", "FILE", ".mha: float32 in the picture's unit (HU, line integral, …); .png: what a person sees"},
    {"--backend", "gpu|cpu|reference", "default gpu where GL 4.3 has hardware, else cpu"},
    kLibrary,
    kJson};
constexpr Option kSheetOptions[] = {
    {"--out", "FILE.html", "the page"}, {"--backend", "gpu|cpu|reference", "as of render"}, kLibrary};
constexpr Option kSimulateOptions[] = {
    kLibrary,
    {"--case", "ID", "the case"},
    {"--lesion", "ID", "the target; default the case's first lesion"},
    {"--operator", "novice|intermediate|expert|learner|FILE.json",
     "who (docs/operators.md); a learner is better with each attempt"},
    {"--seed", "N", "attempt i uses seed N + i"},
    {"--count", "K", "how many attempts, of each person; default 1"},
    {"--people", "P",
     "of P different people with that profile: the same for the same seed; default the profile itself"},
    {"--jobs", "N", "threads; default one for each core. The results are the same"},
    {"--no-pictures", nullptr, "store no picture of the moment of firing"},
    {"--instrument", "access|core", "default the case's. access: the tip decides; core: the fired notch"},
    {"--modality", "mpr|xray|ultrasound", "default the case's; else one of its further ones"},
    {"--event", "KIND@SECONDS",
     "a mentor's event at that time: cough, bleeding or pressure_drop; may be given many times", true},
    {"--real-time", nullptr, "as a person would: 1 kHz by the clock, stored while it runs; not under xray"},
    {"--resume", "ATTEMPT",
     "go on with an interrupted attempt in real time: case, needle and seed are its own, and so is the operator, "
     "unless --operator names the file it was made with; give its --event again"},
    kJson};
constexpr Option kScoreOptions[] = {kLibrary,
                                    {"--poses", "FILE.csv", "poses of an attempt made elsewhere"},
                                    {"--scene", "SCENE.json", "the scene they were made in"},
                                    kJson};
constexpr Option kRecomputeOptions[] = {
    kLibrary, {"--attempt", "ID", "this one only; default: every attempt"}, kJson};
constexpr Option kExportOptions[] = {
    kLibrary,
    {"--out", "DIR", "the new folder"},
    {"--case", "ID", "attempts at this case only; default: every attempt"},
    {"--raw", "poses,forces,frames,events|none", "what of the recordings; default all of them"},
    {"--key", "FILE",
     "makes the names of people, attempts and cases the same as in other exports with it; made when there is none. "
     "Keep it apart from what you pass on"},
    kJson};
constexpr Option kMeshOptions[] = {kLibrary, {"--out", "FILE.glb", "the file to write"}};
constexpr Option kReplayOptions[] = {
    kLibrary,
    {"--verify", nullptr, "replay the inputs and compare state hashes and poses, tick by tick"},
    {"--out", "FILE.html|FILE.mp4|DIR",
     "a sheet (pictures, way in the body, timeline, metrics), a film (needs ffmpeg), or a new folder of PNG "
     "frames; "
     "compared while it is drawn, nothing is written where it differs"},
    {"--rate-hz", "R", "frames a second of the attempt, 1 to 60; default 10"},
    kJson};
constexpr Option kLevelOption{"--level", "student|trainee|consultant",
                              "who somebody is from now on: attempts of consultants set the standard"};
constexpr Option kUserAddOptions[] = {
    kLibrary, {"--role", "trainee|mentor|researcher|director|admin", "the role"}, kLevelOption};
constexpr Option kUserLevelOptions[] = {kLibrary, kLevelOption};
constexpr Option kCompareOptions[] = {
    kLibrary,
    {"--case", "ID", "the case"},
    {"--lesion", "ID", "of attempts at this target; default that of the newest attempt"},
    {"--modality", "mpr|xray|ultrasound", "of attempts with it; default that of the newest attempt"},
    {"--out", "FILE.html", "a page of its own, in place of the text"},
    kJson};
constexpr Option kCurriculumAddOptions[] = {kLibrary, kByOption, kJson};
constexpr Option kCurriculumByOptions[] = {kLibrary, kByOption};
constexpr Option kCurriculumItemOptions[] = {
    kLibrary,
    {"--case", "ID", "a published case; the item is it in whatever version is published"},
    {"--attempt-limit", "N", "so many a trainee; default the case's own limit"},
    {"--after", "N[:passed|:proficient]", "opens when item N is reached; default passed", true},
    kByOption,
    kJson};
constexpr Option kCurriculumShowOptions[] = {kLibrary, {"--user", "NAME", "how far this person is"}, kJson};
constexpr Option kInsertOptions[] = {
    {"--tissue", "kidney|liver|muscle|fat|skin|…", "a half space of it, behind its capsule"},
    {"--speed-mm-s", "V", "the needle's speed"},
    {"--depth-mm", "D", "how deep, from the first touch of the undeformed capsule"},
    {"--hold-s", "T", "rest at that depth; default 0"},
    {"--retract", nullptr, "then pull back to depth 0"},
    {"--gauge", "G", "16 to 25; default 22"},
    {"--relaxation", nullptr, "held tissue relaxes"},
    {"--out", "FILE.csv", "t_s, depth_mm, force_axial_n (> 0 resists insertion), one row per ms"}};
constexpr Option kSelftestOptions[] = {
    {"--seconds", "S", "how long; default 10"},
    {"--most-missed", "SHARE",
     "of the ticks, before it counts as failed; default 0.05, for a machine that others share"},
    kJson};
constexpr Option kFitOptions[] = {
    {"--tissue", "kidney|liver|muscle|fat|skin|…", "the row's class; default soft_tissue"},
    {"--gauge", "G", "of the needle it was measured with, 16 to 25; default 22. The row is at 22"},
    {"--gaussians", "K", "1 to 12; default 8 (thesis eq. 5.1)"},
    {"--source", "TEXT", "where the curve was measured; goes into the row"},
    {"--out", "FILE.html", "curve, models and residuals; default FILE.fit.html beside FILE.csv"},
    kJson};
constexpr Option kCalibrateOptions[] = {
    {"--device", "left|right", "which of the station's two"},
    {"--station", "FILE.json", "where its calibration is kept; the other device's stays"},
    {"--device-id", "ID", "the arm that stands there, as `device list` names it"},
    {"--grip-id", "ID", "the stylus on that arm"},
    kJson};
constexpr Option kHost{"--host", "ADDRESS", "where the Haply Inverse service is; default 127.0.0.1"};
constexpr Option kPort{"--port", "N", "its port; default 10001"};
constexpr Option kDeviceListOptions[] = {kHost, kPort, kJson};
constexpr Option kDeviceProbeOptions[] = {
    kHost,
    kPort,
    {"--seconds", "S", "how long; default 3"},
    {"--station", "FILE.json", "whose arms are left and right, and where they stand"},
    kJson};
constexpr Option kDeviceSimulateOptions[] = {
    {"--port", "N", "where to listen on loopback; 0 takes any that is free; default 10001"},
    {"--seconds", "S", "how long; default until it is stopped"},
    {"--delay-ms", "D", "everything is said so much later"},
    {"--lose-every", "S", "hangs up every S seconds"},
    {"--damage-every", "S", "says something broken every S seconds"},
    {"--swap", nullptr, "tells of the arms in the other order"}};
constexpr Option kBenchOptions[] = {
    {"--stage", "a,b",
     "import, mpr, xray, breathing, ultrasound, room, displacement, haptics, step, library, assessment; default "
     "all"},
    {"--quick", nullptr, "fewer repetitions"},
    {"--ct", "SOURCE", "what import reads, and a patient for xray, ultrasound and room; default the built-in case"},
    {"--volume", "FILE", "xray: in place of the projector phantom"},
    {"--out", "DIR", "where results.csv goes"}};
constexpr Option kGoalsOptions[] = {
    {"--method", "scatterers|lattice|thesis|all", "how speckle comes about; default scatterers"},
    {"--probe", "NAME", "C5-2v, L11-5v, thesis-linear or thesis-curved; default all"},
    {"--quality", "fast|reference",
     "reference: 512 beams, 2048 samples, three times the scatterers, against the narrower tolerances; default "
     "fast"},
    {"--quick", nullptr, "fewer frames, so more chance in the figures"},
    kJson};
constexpr Option kDemoOptions[] = {
    {"--library", "DIR", "default seldinger/demo under the user's data folder; reused"},
    {"--ct", "SOURCE", "a CT to use in place of the built-in case; with --cases any number of them", true},
    {"--drills", nullptr,
     "the first hour: three drills on blocks of gel, published, each passed once by a simulated expert whose "
     "replay "
     "is to be watched, and the curriculum that leads through them; takes seconds"},
    {"--cases", nullptr,
     "the drills, then the graded cases: 1, 5 and 6 from the built-in torso, those of a --ct that fits; likewise"},
    {"--calyces", "normal|dilated|opacified", "of the built-in case; default normal"},
    {"--modality", "ultrasound|xray|mpr",
     "ultrasound, fluoroscopy, or CT slices under a probe; default ultrasound"},
    {"--no-serve", nullptr, "end by printing what was made"},
    {"--port", "N", "the page's port; default 8080, or any free one"},
    kJson};
constexpr Option kTrainOptions[] = {
    {"--library", "DIR", "the library; else the demo's"},
    {"--case", "ID", "whoever logs in finds this case's briefing open"},
    {"--device", "mouse|haply|virtual",
     "what holds the tools: mouse, keys, gamepad and 3-D mouse; or two arms of a Haply Inverse service, and these "
     "for what an arm does not hold; or two simulated arms that these lead, to try arms without any; default "
     "mouse"},
    {"--device-host", "ADDRESS", "where the Haply Inverse service is; default 127.0.0.1"},
    {"--device-port", "N", "its port; default 10001"},
    {"--station", "FILE.json",
     "whose arms are left and right, where they stand, and how they are set, as the device page (F10) keeps it; "
     "default with haply ~/.config/seldinger/station.json"},
    {"--left-handed", nullptr, "the needle in the left hand: probe, marker and mouse buttons change sides"},
    {"--backend", "gpu|cpu|auto",
     "what makes ultrasound's pictures; auto, which it is unless given: the GPU where GL has hardware"},
    {"--width", "PIXELS", "of the window, at least 960; 1280 unless given"},
    {"--height", "PIXELS", "of the window, at least 640; 800 unless given"},
    {"--whole-screen", nullptr, "without a frame"},
    {"--mute", nullptr, "without sound, until M is pressed"},
    {"--volume", "PERCENT", "of the sound; 70 unless given"},
    {"--pictures", "DIR", "where F12 keeps pictures of the window; else the working folder"},
    {"--trace", "FILE.jsonl", "screen, rates and lags, four times a second"},
};
constexpr Option kServeOptions[] = {kLibrary,
                                    {"--host", "ADDRESS", "default 127.0.0.1; only loopback for now"},
                                    {"--port", "N", "default 8080; 0 takes any free one"}};

constexpr Command kCommands[] = {
    {"import", "SOURCE", 1, 1, kImportOptions,
     "Reads a CT (DICOM folder or file, .nii .nii.gz .nrrd .nhdr .mha .mhd) into the library as a case.",
     &run_import},
    {"sample", "CASE", 1, 1, kSampleOptions, "Prints the HU at points of a case.", &run_sample},
    {"case list", "", 0, 0, kLibraryJson, "Lists the cases, oldest first.", &run_case_list},
    {"case show", "CASE", 1, 1, kLibraryJson, "Shows one case.", &run_case_show},
    {"case explain", "CASE", 1, 1, kLibraryJson,
     "Lists what a case's scene holds in memory, what can move its tissue, and what that costs.",
     &run_case_explain},
    {"case lesion", "CASE", 1, 1, kLesionOptions, "Places a lesion in a case.", &run_case_lesion},
    {"case mesh", "CASE", 1, 1, kMeshOptions, "Writes a case's skin as binary glTF, for browsers and others.",
     &run_case_mesh},
    {"case structure", "CASE", 1, 1, kStructureOptions,
     "Adds a structure to a case: a tissue class, a label, or drawn; and what touching it means.",
     &run_case_structure},
    {"case label", "CASE FILE", 2, 2, kLabelOptions,
     "Adds a label map (NIfTI, NRRD, MetaImage) to a case; another grid is resampled by the nearest voxel.",
     &run_case_label},
    {"case setting", "CASE", 1, 1, kSettingOptions,
     "Sets what a case asks of whoever attempts it: guidance, needle, patient, limits, pass rule. What is not "
     "given "
     "stays.",
     &run_case_setting},
    {"case check", "CASE", 1, 1, kLibraryJson,
     "Tells whether a case is worth an attempt, and what its rule may name; 1 when it is not.", &run_case_check},
    {"case confirm", "CASE", 1, 1, kConfirmOptions,
     "Keeps that somebody looked through a case's slices and saw no text burned in: publishing asks for it.",
     &run_case_confirm},
    {"case review", "CASE", 1, 1, kReviewOptions,
     "Submits a draft to review; with --approve or --return a second person's answer.", &run_case_review},
    {"case publish", "CASE", 1, 1, kPublishOptions,
     "Publishes a case that holds its check and was approved; it never changes again.", &run_case_publish},
    {"case retire", "CASE", 1, 1, kRetireOptions, "Retires a published case; its attempts stay.", &run_case_retire},
    {"case version", "CASE", 1, 1, kVersionOptions, "Makes the next version of a case, as a draft.",
     &run_case_version},
    {"deidentify", "IN OUT", 2, 2, kDeidentifyOptions,
     "Writes DICOM without identity (PS3.15 Basic Profile 2024b): a file, or a folder with all below it, into a "
     "new "
     "folder. Pixels stay as they are.",
     &run_deidentify},
    {"case bundle", "CASE", 1, 1, kBundleOptions,
     "Writes a case as one checked file for another library; attempts and people stay.", &run_case_bundle},
    {"bundle export", "", 0, 0, kBundleOptions, "Writes every case of a library as one such file.",
     &run_bundle_export},
    {"bundle import", "FILE.sdbundle", 1, 1, kLibraryJson,
     "Checks such a file and takes its cases into the library, all or none; a case that is there already stays.",
     &run_bundle_import},
    {"bundle check", "FILE.sdbundle", 1, 1, kJsonOnly, "Checks such a file, every byte of it.", &run_bundle_check},
    {"backup", "OUT", 1, 1, kLibraryJson,
     "Copies a library, also one in use, into a new folder and checks the copy. It holds names: keep it as safe.",
     &run_backup},
    {"restore", "IN", 1, 1, kLibraryJson,
     "Makes a library from a backup, checked before it is there; never over another.", &run_restore},
    {"check", "", 0, 0, kCheckOptions,
     "Checks a library: pages, references, files, recordings, leftovers, names; 1 when something does not hold.",
     &run_check},
    {"render", "SCENE.json", 1, 1, kRenderOptions, "Renders a scene's view (mpr, xray, ultrasound, room).",
     &run_render},
    {"sheet", "SHEET.json", 1, 1, kSheetOptions, "Renders scenes side by side into one page of pictures.",
     &run_sheet},
    {"simulate", "", 0, 0, kSimulateOptions, "Lets a simulated operator make attempts, recorded and scored.",
     &run_simulate},
    {"score", "[ATTEMPT]", 0, 1, kScoreOptions, "Computes the metrics of a stored attempt, or of a pose file.",
     &run_score},
    {"replay", "ATTEMPT", 1, 1, kReplayOptions, "Replays a stored attempt.", &run_replay},
    {"recompute", "", 0, 0, kRecomputeOptions,
     "Scores stored attempts again: new versions of metrics are added, those that are there are compared.",
     &run_recompute},
    {"export", "", 0, 0, kExportOptions,
     "Writes attempts as CSV with a data dictionary into a new folder: no names, no dates (docs/export.md).",
     &run_export},
    {"attempt list", "", 0, 0, kLibraryJson, "Lists the attempts, newest first.", &run_attempt_list},
    {"attempt show", "ATTEMPT", 1, 1, kLibraryJson, "Shows one attempt with its metrics.", &run_attempt_show},
    {"attempt compare", "", 0, 0, kCompareOptions,
     "Puts the attempts on a case side by side, a group for each person and each simulated operator.",
     &run_attempt_compare},
    {"curriculum add", "TITLE", 1, 1, kCurriculumAddOptions, "Makes a curriculum, as a draft; by a mentor.",
     &run_curriculum_add},
    {"curriculum item", "CURRICULUM", 1, 1, kCurriculumItemOptions, "Adds a case at a draft's end; by a mentor.",
     &run_curriculum_item},
    {"curriculum publish", "CURRICULUM", 1, 1, kCurriculumByOptions,
     "Publishes a curriculum, by a director; it never changes again.", &run_curriculum_publish},
    {"curriculum list", "", 0, 0, kLibraryJson, "Lists the curricula, oldest first.", &run_curriculum_list},
    {"curriculum show", "CURRICULUM", 1, 1, kCurriculumShowOptions,
     "Shows a curriculum's items; with --user what was reached and which is due.", &run_curriculum_show},
    {"curriculum remove", "CURRICULUM", 1, 1, kCurriculumByOptions,
     "Takes a draft away, by a mentor; retires a published one, by a director.", &run_curriculum_remove},
    {"user add", "NAME", 1, 1, kUserAddOptions, "Adds an account; the password is read from standard input.",
     &run_user_add},
    {"user list", "", 0, 0, kLibraryJson, "Lists the accounts.", &run_user_list},
    {"user passwd", "NAME", 1, 1, kLibraryOnly, "Sets a password, read from standard input.", &run_user_passwd},
    {"user level", "NAME", 1, 1, kUserLevelOptions,
     "Sets who somebody is from now on; earlier attempts count as before.", &run_user_level},
    {"user disable", "NAME", 1, 1, kLibraryOnly, "Closes an account; its attempts stay.", &run_user_disable},
    {"haptics insert", "", 0, 0, kInsertOptions,
     "Drives a needle into one tissue and writes its force against depth.", &run_haptics_insert},
    {"haptics fit", "FILE.csv", 1, 1, kFitOptions,
     "Fits a plateau behind a capsule, and a sum of Gaussians, to a measured insertion: columns depth_mm, from the "
     "touch, and force_axial_n, > 0 resists.",
     &run_haptics_fit},
    {"haptics calibrate", "POINTS.csv", 1, 1, kCalibrateOptions,
     "Finds where a device stands on the template (156 mm square, cross of 128 mm, box of 143 mm): columns point, "
     "x_mm, y_mm, z_mm as the device reads them at a, b, c, d, f and, where taken, e. Refused above 1 mm.",
     &run_haptics_calibrate},
    {"haptics stability", "", 0, 0, kJsonOnly,
     "Measures under simulated hands and devices whether forces come to rest; 1 when they do not "
     "(docs/stability.md).",
     &run_haptics_stability},
    {"haptics selftest", "", 0, 0, kSelftestOptions,
     "Runs the 1 kHz servo with two virtual devices on the built-in torso; 1 when it misses too many ticks.",
     &run_haptics_selftest},
    {"device list", "", 0, 0, kDeviceListOptions,
     "Lists what hands can use here: arms and grips of a Haply Inverse service, a 3-D mouse.", &run_device_list},
    {"device probe", "", 0, 0, kDeviceProbeOptions,
     "Reads both arms for a while, without force: poses, rate, jitter, round trip.", &run_device_probe},
    {"device simulate", "", 0, 0, kDeviceSimulateOptions,
     "Is a Haply Inverse service without hardware: two virtual hands on virtual arms, with faults on request.",
     &run_device_simulate},
    {"bench", "", 0, 0, kBenchOptions, "Measures time against error of every stage with a choice.", &run_bench},
    {"goals ultrasound", "", 0, 0, kGoalsOptions,
     "Measures the ultrasound picture against closed forms, goal by goal; 1 when scatterers miss one.",
     &run_goals_ultrasound},
    {"goals haptics", "", 0, 0, kJsonOnly,
     "Measures what the hand feels against published lines and under simulated hands; 1 when a goal is missed.",
     &run_goals_haptics},
    {"doctor", "", 0, 0, kLibraryJson,
     "Tells what this machine can do: GL, devices, real-time rights, disk, schema.", &run_doctor},
    {"demo", "", 0, 0, kDemoOptions, "The main job, end to end, on real or built-in CT.", &run_demo},
    {"train", "", 0, 0, kTrainOptions,
     "The trainer's window: log in, choose a case, puncture under guidance with mouse and keys or two arms, and be "
     "told how it "
     "went.",
     &run_train},
    {"serve", "", 0, 0, kServeOptions, "Serves the library's pages on this machine.", &run_serve},
    {"help", "[COMMAND]", 0, 2, kHelpOptions, "Prints this, or one command's options.", &run_help},
};

std::string synopsis(const Command& command) {
  std::string text = std::string("seldinger ") + command.name;
  if (*command.positionals != '\0') text += std::string(" ") + command.positionals;
  for (const Option& option : command.options) {
    text += std::string(" [") + option.name;
    if (option.value != nullptr) text += std::string(" ") + option.value;
    text += option.repeatable ? " …]" : "]";
  }
  return text;
}

}  // namespace

std::span<const Command> commands() {
  return kCommands;
}

std::string help_text(const Command& command) {
  std::string text = synopsis(command) + "\n  " + command.summary + "\n";
  for (const Option& option : command.options) {
    std::string name = option.name;
    if (option.value != nullptr) name += std::string(" ") + option.value;
    name.resize(std::max<std::size_t>(name.size(), 26), ' ');
    text += "  " + name + " " + option.help + "\n";
  }
  return text;
}

std::string help_text() {
  std::string text =
      "seldinger: training in image-guided needle puncture. Training only, not for planning a patient's "
      "procedure.\n\n";
  for (const Command& command : commands()) {
    std::string name = command.name;
    if (*command.positionals != '\0') name += std::string(" ") + command.positionals;
    name.resize(std::max<std::size_t>(name.size(), 22), ' ');
    text += "  " + name + " " + command.summary + "\n";
  }
  return text + "\n`seldinger help COMMAND` lists a command's options; `seldinger --version` prints the version.\n";
}

std::string commands_markdown() {
  std::string text =
      "# Commands\n\nMade from the table in `app/command.cpp` by `seldinger help --commands`; a test compares.\n"
      "Lengths in mm, coordinates in LPS. Exit codes: 0 done · 1 ran and its check did not hold · 2 usage · "
      "3 the input is refused, nothing is changed · 4 the environment fails (disk, database, GL).\n";
  for (const Command& command : commands()) {
    text += "\n## " + std::string(command.name) + "\n\n" + command.summary + "\n\n```\n" + synopsis(command) +
            "\n```\n";
    if (command.options.empty()) continue;
    text += "\n| option | what |\n|---|---|\n";
    for (const Option& option : command.options) {
      std::string value = option.value == nullptr ? "" : std::string(" ") + option.value;
      for (std::size_t at = 0; (at = value.find('|', at)) != std::string::npos; at += 2)
        value.replace(at, 1, "\\|");
      text += "| `" + std::string(option.name) + value + "` | " + option.help + " |\n";
    }
  }
  return text;
}

int refuse(const base::Error& error) {
  std::fprintf(stderr, "error: %s: %s\n", error.code.c_str(), error.text.c_str());
  for (const base::Problem& finding : error.findings)
    std::fprintf(stderr, "finding: %s: %s\n", finding.code.c_str(), finding.text.c_str());
  return kRefused;
}

}  // namespace seldinger::app
