# SPDX-License-Identifier: GPL-3.0-only
"""What pictures of studies go over."""

from pictures import PictureTest
from real_results import real_result
import study
from style import plt


class StudyTest(PictureTest):
    def test_parameters_are_those_that_are_varied(self):
        varied = study.varied_parameters(real_result("study-a"))
        self.assertEqual([parameter.name for parameter in varied], ["Mesh/Degree", "Mesh/Face size"])
        self.assertEqual(study.choose_abscissa(varied).label, "face size [mm]")

    def test_labels_of_logarithms_stay_apart(self):
        for low in (0.14, 2.1):
            for ratio in (1.1, 3, 4.9, 5.1, 20, 1e4):
                figure, axes = plt.subplots(figsize=(2, 2))
                axes.loglog((low, low * ratio), (low, low * ratio), "o")
                for axis in (axes.xaxis, axes.yaxis):
                    study.plain_logarithms(axis)
                with self.subTest(low=low, ratio=ratio):
                    self.expect_layout(figure)
                    self.assertGreaterEqual(sum(low <= tick <= low * ratio for tick in axes.get_xticks()), 1)
                plt.close(figure)

    def test_a_study_cut_short_is_refused(self):
        (self.folder / "study.journal").touch()
        self.expect_refusal(self.plot(self.folder), "study", "cut short")
