#include "app/cli/error_codes.h"

namespace seldinger::app {
namespace {

constexpr ErrorCode kFilesCodes[] = {
    {"not_found", kRefuses, "The file or folder does not exist.", "Check the path."},
    {"not_readable", kRefuses, "A file or folder cannot be read.", "Check its permissions."},
    {"too_large", kRefuses,
     "A file is larger than this program reads, or would unpack to more than it takes, or a slice has more rows or "
     "columns than DICOM can hold.",
     "Use a smaller file; `import --large` takes more than 4 GiB of voxels."},
    {"exists", kRefuses, "Something of that name is already there, and it is never overwritten.",
     "Give a name that is free, or an empty folder."},
    {"bad_key", kRefuses, "A key file does not hold 64 hexadecimal digits.",
     "Use a key file that this program made."},
    {"bad_csv", kRefuses, "A CSV file lacks a column, or a row is not as its header says.",
     "Mend the rows that are named."},
    {"truncated", kRefuses, "A file, or its pixels, end too early.", "Copy or export it again."},
    {"reader_died", kRefuses,
     "A file from outside stopped the process that read it, or took more memory or time than such a file does; "
     "nothing of it was kept.",
     "Ask where the file came from; export it again."},
    {"damaged", kRefuses, "Stored or copied bytes are not what they must be.",
     "Restore a backup, or copy the file again."}};

constexpr ErrorCode kLibraryCodes[] = {
    {"no_library", kRefuses,
     "There is no library in the folder, or a scene names a case and no `--library` is given.",
     "Check `--library`; `seldinger import` and `seldinger demo` make a library."},
    {"not_a_library", kRefuses, "The folder, or the database in it, is another program's, or is empty.",
     "Give another folder."},
    {"newer_schema", kRefuses, "The library or bundle was written by a newer version of this program.",
     "Update this program."},
    {"network_file_system", kRefuses, "SQLite's locks are not reliable on a network file system.",
     "Keep the library on a local disk."},
    {"no_backup", kRefuses, "The folder holds no backup.", "Give the folder that `seldinger backup` made."},
    {"not_a_bundle", kRefuses, "The file is not a bundle.",
     "Give a file that `case bundle` or `bundle export` made."},
    {"bundle_version", kRefuses, "The bundle's format is newer than this program.", "Update this program."},
    {"case_differs", kRefuses, "A case of the bundle is in the library with other content.",
     "Import the bundle into another library."},
    {"asset_missing", kRefuses | kFinds, "A file of `assets/` is missing.", "Restore a backup."},
    {"asset_damaged", kRefuses | kFinds, "A file of `assets/` no longer has the content that its name promises.",
     "Restore a backup."},
    {"asset_orphaned", kFinds, "A file of `assets/` belongs to no row; an import may be under way.",
     "`seldinger check --repair` when nothing is being imported."},
    {"unknown_file", kFinds, "`assets/` holds files that are not this program's.", "Move them out."},
    {"leftover_file", kFinds, "A temporary file was left behind by a program that died.",
     "`seldinger check --repair`."},
    {"database_damaged", kFinds, "SQLite finds a database damaged.", "Restore a backup."},
    {"reference_broken", kFinds, "A row refers to one that is not there.", "Restore a backup."},
    {"recording_damaged", kFinds, "An attempt's recording is damaged.",
     "Restore a backup; the other attempts are not affected."},
    {"incomplete", kRefuses | kFinds, "A piece of a recording is missing.", "Restore a backup."},
    {"recording_version", kRefuses, "A recording has a format that this program does not know.",
     "Update this program."},
    {"name_without_person", kFinds, "A name belongs to a person who is not in the library.", "Restore a backup."}};

constexpr ErrorCode kCaseCodes[] = {
    {"no_case", kRefuses, "There is no such case, or none at all.", "`seldinger case list` lists them."},
    {"no_lesion", kRefuses, "The case has no lesion, or none of that id.",
     "`seldinger case show` lists them; `case lesion` adds one."},
    {"no_structure", kRefuses, "The case has no structure of that name.", "`seldinger case show` lists them."},
    {"no_label", kRefuses, "No label map of the case has this label.", "Use a label that is in the map."},
    {"no_labels", kRefuses, "The case has no label map.", "`seldinger case label` adds one."},
    {"bad_lesion", kRefuses, "A lesion's place, size or HU is out of range.",
     "Stay within what the message states."},
    {"bad_structure", kRefuses, "A structure's name, tissue, HU or place cannot be used.",
     "Stay within what the message states."},
    {"bad_geometry", kRefuses, "A drawn shape or the geometry of a picture is degenerate or out of range.",
     "Stay within what the message states."},
    {"bad_labels", kRefuses, "A label map does not fit: its values, its names, or where it lies.",
     "Give a map with whole numbers from 0 to 255 that covers the case."},
    {"labels_elsewhere", kRefuses, "Labelled voxels lie outside the case's volume.", "Give the map of this CT."},
    {"bad_setting", kRefuses, "A case's setting is out of range or contradicts itself.",
     "Each `finding:` line names one reason."},
    {"bad_title", kRefuses, "A title is empty, too long, or has more than one line.", "Shorten it."},
    {"bad_note", kRefuses, "A note has more than one line or more than 1000 bytes.", "Shorten it."},
    {"bad_rule", kRefuses, "A pass rule cannot be read.",
     "An object with a list `criteria`, as docs/grading.md has it."},
    {"bad_criterion", kRefuses, "A criterion of a pass rule cannot be read.",
     "The message names the criterion and what is wrong with it."},
    {"unknown_metric", kRefuses | kFinds, "A pass rule names a metric that does not exist.",
     "`seldinger help --metrics` lists them."},
    {"other_version", kRefuses | kFinds, "A pass rule names a version of a metric that is no longer measured.",
     "Name the present version, or none."},
    {"not_meaningful", kRefuses | kFinds, "A metric of a pass rule can have no value on this case.",
     "`seldinger case check` lists what the rule may name."},
    {"twice", kRefuses | kFinds, "A pass rule asks for the same metric twice in the same way.", "Drop one."},
    {"not_finite", kRefuses | kFinds,
     "A value is not a finite number: a voxel, a row of a curve, a force, the limit of a criterion.",
     "Give a number."},
    {"has_attempts", kRefuses, "Attempts were made on this draft, so that it no longer changes.",
     "`seldinger case version` makes the next version."},
    {"not_a_draft", kRefuses, "Only a draft is changed.", "`seldinger case version` makes the next version."},
    {"bad_state", kRefuses, "The case or curriculum is not in the state that this step starts from.",
     "The message names the state."},
    {"checks_failed", kRefuses, "The case does not hold its check.",
     "`seldinger case check`; each `finding:` line names one reason."},
    {"lesion_present", kRefuses | kFinds, "There is no lesion.", "`seldinger case lesion` adds one."},
    {"lesion_inside_body", kRefuses | kFinds, "A lesion lies or sticks out of the body.",
     "Move it or make it smaller."},
    {"lesion_not_in_bone", kRefuses | kFinds, "More than 5 % of a lesion is bone.", "Move it."},
    {"lesion_reachable", kRefuses | kFinds, "No straight path from the skin to a lesion is free.",
     "Move it, or remove a structure in the way."},
    {"entry_on_skin", kRefuses | kFinds, "The planned entry lies more than 5 mm off the skin.",
     "Move it: `case setting --entry-mm`."},
    {"structure_in_volume", kRefuses | kFinds, "A drawn structure reaches out of the volume.",
     "Move it or make it smaller."},
    {"rule_present", kRefuses | kFinds, "The case has no pass rule.", "`seldinger case setting --pass`."},
    {"rule_meaningful", kRefuses | kFinds, "A criterion of the pass rule means nothing on this case.",
     "`seldinger case check` lists what the rule may name."},
    {"burned_in_unchecked", kRefuses, "Nobody has confirmed that the pictures hold no burned-in text.",
     "Look through the slices, then `seldinger case confirm --no-burned-in-text`."},
    {"not_checked", kRefuses, "This server cannot run the check of a case.",
     "`seldinger case check` on the command line."}};

constexpr ErrorCode kPeopleCodes[] = {
    {"no_user", kRefuses, "There is no such account, or it is closed.", "`seldinger user list` lists them."},
    {"no_person", kRefuses, "There is no such person in the library.", ""},
    {"name_taken", kRefuses, "The name is in use: by an account, or by a structure of the case.",
     "Choose another."},
    {"bad_name", kRefuses, "A login name has other than 1 to 64 printable characters.", "Choose another."},
    {"weak_password", kRefuses, "A password has other than 8 to 128 bytes.", "Choose another."},
    {"not_allowed", kRefuses, "The account's role may not do this.",
     "Ask somebody whose role may; the message names it."},
    {"too_few_consultants", kRefuses, "Too few consultants have made enough attempts for a standard.",
     "The message says how many; docs/grading.md says what counts."},
    {"same_standard", kRefuses, "The standard in force is made of the same values.",
     "There is nothing to set until consultants have made more attempts, or `seldinger recompute` new versions."},
    {"no_cohort", kRefuses, "There is no such cohort.", "`seldinger cohort list` lists them."},
    {"not_enrolled", kRefuses, "The person does not belong to the cohort, or does not direct the programme, now.",
     "`seldinger cohort show` tells who does."},
    {"title_taken", kRefuses, "A cohort or study has this title already.", "Choose another."},
    {"no_study", kRefuses, "There is no such study.", "`seldinger study list` lists them."},
    {"bad_text", kRefuses, "A consent text is empty, too long, or not UTF-8 text.",
     "Give 1 to 20,000 bytes of plain text."},
    {"no_text", kRefuses, "There is no such consent text, or a newer version is asked for now.",
     "`seldinger consent list` lists them."},
    {"not_given", kRefuses, "No consent stands that could be withdrawn.",
     "`seldinger consent list` tells what stands."},
    {"unknown_fact", kRefuses, "There is no such fact about a person.", "`seldinger user fact NAME` lists them."},
    {"bad_answer", kRefuses, "The answer is not one of the words, or not within the limits, of the fact.",
     "The message tells what is asked for."},
    {"no_curriculum", kRefuses, "There is no such curriculum in the library.",
     "`seldinger curriculum list` lists them."},
    {"no_items", kRefuses, "The curriculum has no item.", "`seldinger curriculum item` adds one."},
    {"bad_item", kRefuses, "An item's limit or gate is out of range.",
     "A limit is 1 to 1000; a gate names an earlier item, once."},
    {"case_taken", kRefuses, "The curriculum already has an item with that case.", "Use another case."},
    {"not_published", kRefuses, "A curriculum takes only cases that are published and not retired.",
     "Publish the case first."},
    {"no_rule", kRefuses, "A case without a pass rule cannot be an item: nobody could pass it.",
     "`seldinger case setting --pass` on its next version."},
    {"no_attempts_left", kRefuses, "As many attempts as the case or curriculum allows have been made.", ""}};

constexpr ErrorCode kAttemptCodes[] = {
    {"attempt_runs", kRefuses, "Somebody is at this attempt right now.", "Wait until it has ended."},
    {"not_simulated", kRefuses, "A person made this attempt, not a simulated operator.",
     "Go on with it in `seldinger train`."},
    {"not_the_same", kRefuses,
     "A tick of the interrupted attempt does not come out as it was recorded, so that it cannot be resumed.",
     "Start a new attempt."},
    {"nothing_recorded", kRefuses, "The attempt ended before anything of it was stored.", "Start a new attempt."},
    {"other_case", kRefuses, "The interrupted attempt was made at another task.", "Resume it at its own case."},
    {"state_version", kRefuses, "The state was saved by another version of the simulation.",
     "Resume it with the program that saved it."},
    {"step_version", kRefuses, "The attempt was recorded by another version of the simulation's step.",
     "Resume it with the program that recorded it."},
    {"no_attempt", kRefuses, "There is no such attempt.", "`seldinger attempt list` lists them."},
    {"other_modality", kRefuses, "The case is not practised with this modality.",
     "`case setting --also` allows a further one."},
    {"no_patient", kRefuses, "`--event` is for patients, and the case is a phantom.", "Leave `--event` out."},
    {"not_in_real_time", kRefuses, "Simulated attempts under fluoroscopy run in virtual time only.",
     "Leave `--real-time` out."},
    {"bad_operator", kRefuses, "A simulated operator's file is not a JSON object, or a field of it is wrong.",
     "docs/operators.md."},
    {"bad_field", kRefuses, "A field is missing or out of its range.", "The message names it."},
    {"unknown_field", kRefuses, "There is a field that is not known.", "Remove it, or check its spelling."},
    {"no_path", kRefuses, "No straight path from the skin to the target is free of bone, gas and structures.",
     "Move the lesion, or remove a structure."},
    {"no_lesion_site", kRefuses, "No place in the volume fits the rule for a lesion.",
     "Place one yourself: `seldinger case lesion`."},
    {"no_case_fits", kRefuses, "No graded case can be made of this CT.", "Use the built-in torso or another CT."},
    {"never_passed", kRefuses, "No simulated expert passes the case that was made.",
     "Report it: the built-in cases must be passable."},
    {"bad_skin", kRefuses, "A skin surface does not tell inside from outside.", "Import the case again."},
    {"bad_target", kRefuses, "The target is not a sphere of finite size.", ""},
    {"bad_plan", kRefuses, "The planned entry is not a point with a direction.", ""},
    {"bad_poses", kRefuses, "Poses are missing, not finite, or not in the order of time.",
     "The message names the row."},
    {"bad_forces", kRefuses, "Forces are not finite or not in the order of time.", "The message names the row."},
    {"bad_frames", kRefuses, "A frame's time is not finite.", ""},
    {"bad_events", kRefuses, "An event's time is not finite.", ""}};

constexpr ErrorCode kSceneCodes[] = {{"bad_scene", kRefuses, "A scene file is not as docs/scenes/README.md has it.",
                                      "Each `finding:` line names one field."},
                                     {"bad_sheet", kRefuses, "A sheet file is not as docs/scenes/README.md has it.",
                                      "The message names the field."}};

constexpr ErrorCode kDeviceCodes[] = {
    {"no_device", kRefuses, "No Haply Inverse service answers, or no arm with its grip is there.",
     "Start the service; `seldinger device list`."},
    {"no_space_mouse", kRefuses, "spacenavd does not answer.",
     "Install and start it, or go on without a 3-D mouse."},
    {"bad_address", kRefuses, "The address to listen on is not one of this machine.", "Use 127.0.0.1."},
    {"bad_station", kRefuses, "The station's file cannot be read.",
     "Set the device page (F10) or `haptics calibrate` up again."},
    {"bad_points", kRefuses, "A calibration point is missing, unknown, double or not finite.",
     "The message names the point."},
    {"wrong_point", kRefuses, "A calibration point does not fit to the others.", "Measure that point again."},
    {"collinear", kRefuses, "The calibration points lie on one line or spot.",
     "Measure them again, each at its place."},
    {"coplanar", kRefuses, "Point f of the calibration lies in the plane of the board.",
     "Measure f on top of the box."},
    {"mirrored", kRefuses,
     "Point f of the calibration comes out below the board: the points were taken in another order, or an axis of "
     "the device is turned over.",
     "Take the points in their order; check the device's axes."},
    {"wrong_scale", kRefuses, "The device would have to be scaled to fit the template.",
     "Give its readings in millimetres."},
    {"out_of_range", kRefuses, "A row of a force curve is beyond 1000 mm or 500 N.",
     "Give millimetres and newtons."},
    {"too_shallow", kRefuses, "A force curve is too short to tell a capsule from a plateau.", "Measure deeper."},
    {"starts_late", kRefuses, "A force curve starts below the first touch.", "Count depth from the first touch."},
    {"not_one_insertion", kRefuses, "A force curve is pulled back on the way in.", "Give one insertion."},
    {"no_resistance", kRefuses, "No force of the curve is above 0.", "Give resistance as positive."},
    {"too_few_rows", kRefuses, "A force curve has too few rows.", "Sample it more finely."},
    {"no_plateau", kRefuses, "The force comes to no plateau of 5 mm within the curve.", "Measure deeper."},
    {"too_long", kRefuses, "An insertion takes more than 5,000,000 samples.", "Make it faster or shorter."}};

constexpr ErrorCode kDeidentificationCodes[] = {
    {"no_instance", kRefuses, "A DICOM file has no UID of what it holds.", ""},
    {"too_deep", kRefuses, "A DICOM file nests sequences too deeply.", ""},
    {"unknown_object", kRefuses, "A DICOM file is of a kind that the standard does not define, or raw data.",
     "Leave it out."},
    {"report", kRefuses, "A report, document or annotation, whose text cannot be made safe.", "Leave it out."},
    {"may_have_text", kRefuses, "Ultrasound or a photograph that does not state that no text is burned in.",
     "Leave it out."},
    {"nothing_left", kRefuses, "No file can be handed on.", "Each `finding:` line counts one reason."},
    {"left_handed", kRefuses, "A volume's axes are left-handed, which DICOM cannot express.", ""},
    {"sheared", kRefuses, "A volume's axes are not perpendicular, which DICOM cannot express.", ""}};

constexpr ErrorCode kImportCodes[] = {
    {"unknown_format", kRefuses,
     "The source is not DICOM, NIfTI, NRRD or MetaImage, or uses a part of its format that is not read.",
     "Convert it."},
    {"empty_folder", kRefuses, "The folder holds no file.", "Check the path."},
    {"no_dicom", kRefuses, "No file of the folder is DICOM.", "Check the path."},
    {"dicomdir", kRefuses, "A DICOMDIR, a list of files, which is not followed.", "Give the folder."},
    {"no_image", kRefuses, "DICOM without an image.", "Give a CT series."},
    {"not_ct", kRefuses, "DICOM objects other than CT images.", "Give a CT series."},
    {"secondary_capture", kRefuses, "Captured screen pictures, which may show text and hold no HU.",
     "Give a CT series."},
    {"parametric_map", kRefuses, "Parametric maps, which hold no HU.", "Give a CT series."},
    {"encapsulated_document", kRefuses, "Documents (PDF or such).", "Give a CT series."},
    {"localizer", kRefuses, "Localizer pictures, which are not slices.", "Give a CT series."},
    {"derived", kRefuses, "A projection (MIP, VRT, SSD …) or a map of another quantity.",
     "Give the original series."},
    {"rgb", kRefuses, "Colour pictures.", "Give a CT series."},
    {"burned_in", kRefuses, "Text is burned into the picture, or it is a picture of a screen.",
     "Give pictures without text."},
    {"face", kRefuses, "A face is in the volume.", "`--face crop` or `--face deface` (decision 0017)."},
    {"face_only", kRefuses, "Nothing but the face is left to keep below the chin.", "`--face deface`."},
    {"not_dicom", kWarns | kRefuses,
     "Files with the ending of the slices are not DICOM; were they slices, the series is not whole. "
     "De-identification refuses such a file.",
     "Check that the series is whole."},
    {"left_out", kWarns, "Files that are no CT slice, counted by kind.", ""},
    {"series_left_out", kWarns, "Another CT series of which no slice can be read.", ""},
    {"several_series", kRefuses, "The source holds several series.", "Choose one: `--series`."},
    {"series", kRefuses, "One of the series to choose from, with its number.", "Choose one: `--series`."},
    {"no_series", kRefuses, "There is no such series.",
     "`--series` takes a UID or a number that the message lists."},
    {"single_slice", kWarns, "The case is one slice.", ""},
    {"denoised", kWarns, "Anisotropic diffusion was asked for: the noise before and after.", ""},
    {"mixed_orientation", kWarns | kRefuses,
     "Pictures at 45° or more to the series: up to a quarter of it (a localizer, a reformat) are left out, more "
     "are refused.",
     "Give one series."},
    {"mixed_size", kRefuses, "The slices differ in width, height or pixel spacing.", "Give one series."},
    {"duplicate_slices", kWarns | kRefuses,
     "Slices at one place: with the same pixels they are dropped, with other pixels refused, as several times or "
     "series in one.",
     "Give one phase."},
    {"uneven_slices", kWarns | kRefuses,
     "Slices are missing or uneven: interpolated linearly at the usual gap; a hole wider than 10 mm, or more "
     "layers to invent than there are slices, is refused.",
     "Give the whole series."},
    {"shifted_slices", kWarns | kRefuses,
     "Slices off their common line: by up to half a gap they are moved back along their plane, by more refused.",
     "Give the original series."},
    {"gantry_tilt", kWarns | kRefuses, "A leaning stack: 0.1° to 30° is moved back along its planes, more refused.",
     ""},
    {"sparse_slices", kWarns, "Gaps wider than 1.5 slice thicknesses: what lies between was not scanned.", ""},
    {"lossy", kWarns | kRefuses, "Compressed with loss: up to 8:1 a warning; above, or labelled lossless, refused.",
     "Give the original series."},
    {"no_rescale", kWarns, "Slope or intercept is missing: 1 and 0 are taken.", ""},
    {"bad_rescale", kRefuses, "Slope or intercept cannot be used.", "Export the series again."},
    {"not_hu", kWarns | kRefuses,
     "The values are not said to be HU; said to be another quantity (mg/ml, electron density …) they are refused.",
     "Give a series in HU."},
    {"coarse_hu", kWarns, "A stored step is more than 8 HU.", ""},
    {"monochrome1", kWarns, "Low values are meant to be shown bright; HU do not change.", ""},
    {"secondary", kWarns, "Derived pictures: text may be burned in.", "Look for text in them."},
    {"wrong_syntax", kWarns, "Explicit and implicit VR are mixed up; the file is read as it is written.", ""},
    {"no_air", kWarns, "Nothing is below −200 HU.", "Check that the values are HU."},
    {"two_geometries", kWarns, "A NIfTI header also gives a place in another frame, which is not used.", ""},
    {"hu_at_limit", kWarns, "Voxels at 32767 HU, the most that is kept.", ""},
    {"unknown_pixels", kRefuses, "Pixels are stored in a way that is not read.", "Convert them."},
    {"not_scalar", kRefuses, "A voxel is not one plain number.", "Give a CT volume."},
    {"not_3d", kRefuses, "The file holds no volume, or more than one.", "Give one volume."},
    {"multi_frame", kRefuses, "Frames that do not say where each lies.", "Export single slices."},
    {"no_geometry", kRefuses, "Position, orientation or spacing is missing, unsound or out of range.",
     "Export the series again."},
    {"unknown_syntax", kRefuses, "Packed in a way that is not read.", "Unpack it, e.g. with `gdcmconv --raw`."},
    {"bad_size", kRefuses,
     "More than 2³⁰ voxels, more than 4096 along an axis, more than 1 GiB a file, or packed more tightly than CT "
     "can be.",
     "Crop or resample the volume."},
    {"too_many_slices", kRefuses, "More slices than are read.", "Give one series."},
    {"too_many_files", kRefuses, "More files in a folder than are read.", "Give a smaller folder."},
    {"no_body", kRefuses, "Nothing is denser than air: there is no skin.", "Check that the values are HU."},
    {"bad_data_file", kRefuses, "The header names voxels that do not lie in one file beside it.",
     "Write header and voxels into one file."},
    {"no_data_file", kRefuses, "The file with the voxels is not beside its header.", "Put it there."},
    {"more", kRefuses, "There are further problems that are not listed.", "Mend the listed ones first."}};

constexpr ErrorCode kEnvironmentCodes[] = {
    {"measure_not_built", kFails, "Benchmarks and goals are a program of their own, which is not beside this one.",
     "`./run measure` builds it."},
    {"measure_not_started", kFails, "The program of benchmarks and goals cannot be started.",
     "`./run measure` builds it again."},
    {"not_loopback", kRefuses, "The server listens on this machine only.",
     "`--host` is 127.0.0.1, ::1 or localhost."},
    {"bad_port", kRefuses, "A port is 0 to 65535.", "Give such a port."},
    {"port_taken", kRefuses, "Cannot listen on the port, most often because another program does.",
     "Give another `--port`; 0 takes any free one."},
    {"disk", kFails, "The disk is full, or a file or folder cannot be made, read or written.",
     "Free space; check permissions."},
    {"database", kFails, "The database cannot be used, or holds what this program cannot read.",
     "`seldinger check`."},
    {"no_reader", kFails, "No process can be started to read a file from outside.", "Close other programs."},
    {"memory", kFails, "There is not enough memory.", "Close other programs, or use a smaller volume."},
    {"gl", kFails, "OpenGL 4.3 cannot be had or fails.",
     "`seldinger doctor`; `--backend cpu` where a command has it."},
    {"display", kFails, "There is no display to open a window on.", "Run it in a desktop session."},
    {"ffmpeg", kFails, "A film needs ffmpeg, which is missing or failed.",
     "Install ffmpeg, or give a folder for frames."},
    {"network", kFails, "The listening socket failed.", "Start again."},
    {"internal", kFails, "Something unexpected went wrong.", "Report it, with what was done."},
    {"bench_failed", kRefuses, "A benchmark's own attempt cannot be scored.", "Report it."},
    {"embree", kFails, "Embree refused a benchmark's scene.", "Report it."}};

constexpr ErrorCodeSection kSections[] = {{"Files", kFilesCodes},
                                          {"Libraries", kLibraryCodes},
                                          {"Cases", kCaseCodes},
                                          {"People and curricula", kPeopleCodes},
                                          {"Attempts and simulated operators", kAttemptCodes},
                                          {"Scenes and sheets", kSceneCodes},
                                          {"Haptics and devices", kDeviceCodes},
                                          {"De-identification", kDeidentificationCodes},
                                          {"Import", kImportCodes},
                                          {"Serving and the environment", kEnvironmentCodes}};

std::string words_of(unsigned kinds) {
  std::string words;
  const auto add = [&](unsigned kind, const char* word) {
    if ((kinds & kind) != 0) words += (words.empty() ? "" : ", ") + std::string(word);
  };
  add(kWarns, "warning");
  add(kFinds, "1");
  add(kRefuses, "3");
  add(kFails, "4");
  return words;
}

}  // namespace

std::span<const ErrorCodeSection> error_codes() {
  return kSections;
}

std::string errors_markdown() {
  std::string text =
      "# Error codes\n\nMade from the table in `app/cli/error_codes.cpp` by `seldinger help --errors`; a test "
      "compares.\n"
      "An error is one line `error: CODE: text` on standard error; further reasons follow as `finding: CODE: "
      "text`. "
      "Warnings are kept with the case. Codes are stable, texts are not: match on codes. No text holds patient "
      "data.\n\n"
      "Exit: 1 a check ran and found this · 3 the input is refused, nothing is changed · 4 the environment fails · "
      "warning: nothing is refused.\n";
  for (const ErrorCodeSection& section : error_codes()) {
    text += "\n## " + std::string(section.title) +
            "\n\n| code | exit | what it means | what to do |\n|---|---|---|---|\n";
    for (const ErrorCode& one : section.codes)
      text += "| `" + std::string(one.code) + "` | " + words_of(one.kinds) + " | " + one.meaning + " | " +
              (*one.remedy == '\0' ? "–" : one.remedy) + " |\n";
  }
  return text;
}

}  // namespace seldinger::app
