INSERT INTO standard (standard_id, case_id, lesion_id, picture_modality, approach, instrument_kind, set_id, people,
                      attempts, newest_us, set_by, set_us)
VALUES (:standard_id, :case_id, :lesion_id, :picture_modality, :approach, :instrument_kind, :set_id, :people,
        :attempts, :newest_us, :set_by, :set_us)
