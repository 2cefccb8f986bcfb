// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_REPORT_TABLES_H
#define TILTCAL_REPORT_TABLES_H

#include <tiltcal/calibration.h>

#include <string>

namespace tiltcal
{

/// Tables of report.html, as HTML.

/// The verdict and its remarks, a box in the grade's colour.
std::string VerdictBox(const Calibration& calibration);

/// The numbers of every state, then those that all states share.
std::string NumbersTables(const Calibration& calibration);

/// The tilts by blur alone, by geometry alone and jointly. Empty without tilted states and for the paper's model.
std::string EvidenceTable(const Calibration& calibration);

/// The effects: value, significance, held-out error, written or not and why. Empty when none were looked at.
std::string EffectsTable(const Calibration& calibration);

/// The models and what they predict of photographs left out. Empty when none were compared.
std::string ModelsTable(const Calibration& calibration);

/// One row per photograph: how well it fits, how blurred it is, what leaving it out changes.
std::string PhotographsTable(const Calibration& calibration);

/// Correlations of the estimates, coloured by size. Empty when there are none.
std::string CorrelationTable(const Calibration& calibration);

/// What was given by --fix and --prior, and what came of it.
std::string PriorsTable(const Calibration& calibration);

}

#endif
