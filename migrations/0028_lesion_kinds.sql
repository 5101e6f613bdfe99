-- What a lesion is (sim/case/lesion_kind.h); what was called its kind is the form of its outline. Lesions of before
-- stay what their HU say.
ALTER TABLE lesion RENAME COLUMN kind TO outline;
ALTER TABLE lesion ADD COLUMN kind TEXT NOT NULL DEFAULT 'by_hu'
  CHECK (kind IN ('by_hu', 'cyst', 'hcc', 'metastasis', 'haemangioma', 'abscess', 'node', 'isoechoic'));
