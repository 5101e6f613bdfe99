-- What a lesion is (sim/case/lesion_kind.h); its column `kind` is the form of its outline. Lesions of before stay what
-- their HU say.
ALTER TABLE lesion ADD COLUMN lesion_kind TEXT NOT NULL DEFAULT 'by_hu'
  CHECK (lesion_kind IN ('by_hu', 'cyst', 'hcc', 'metastasis', 'haemangioma', 'abscess', 'node', 'isoechoic'));
