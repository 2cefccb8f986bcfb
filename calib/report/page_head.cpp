// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/page_head.h"

namespace tiltcal
{

namespace
{

const char* const HEAD = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"/><meta name="viewport" content="width=device-width"/><title>tiltcal: calibration of a tilted lens</title>
<style>
body { font: 15px/1.5 "Helvetica Neue", Arial, sans-serif; color: #222; max-width: 1180px; margin: 0 auto; padding: 0 20px 60px }
h1 { font-size: 26px; margin: 24px 0 4px } h2 { font-size: 21px; margin: 40px 0 8px; border-bottom: 2px solid #1565c0 } h3 { font-size: 17px; margin: 22px 0 6px }
p { max-width: 860px } code { background: #f2f2f2; padding: 1px 4px; overflow-wrap: anywhere } pre { background: #f2f2f2; padding: 10px; white-space: pre-wrap; overflow-wrap: anywhere }
.wide { overflow-x: auto; margin: 10px 0 16px }
table { border-collapse: collapse; font-size: 14px } th, td { padding: 4px 10px; border-bottom: 1px solid #ddd; text-align: right; vertical-align: top }
td { font-variant-numeric: tabular-nums } th { font-weight: 600; background: #f6f6f6 } th:first-child { text-align: left } tr:first-child th { vertical-align: bottom }
.common td:last-child, .common th:last-child, .run td { text-align: left } .files th:first-child { min-width: 150px; overflow-wrap: anywhere }
.effects td:last-child, .effects th:last-child, .effects td:nth-child(6) { text-align: left; min-width: 150px }
.correlation td { text-align: center; min-width: 44px; border: 1px solid #fff } .correlation td.none { background: #f4f4f4 }
.verdict { border-left: 8px solid #888; background: #f2f2f2; padding: 10px 16px; margin: 14px 0; font-size: 16px } .verdict ul { margin: 6px 0 0; padding-left: 20px; font-size: 14px }
.verdict.good { border-color: #2e7d32; background: #e8f5e9 } .verdict.fair { border-color: #f9a825; background: #fff8e1 } .verdict.poor { border-color: #c62828; background: #ffebee }
svg text { font: 13px "Helvetica Neue", Arial, sans-serif; paint-order: stroke; stroke: #fff; stroke-width: 3px; stroke-linejoin: round }
svg text.title { font-size: 15px; font-weight: 600 } svg text.strong { font-weight: 600 } svg text.number { font-size: 15px; font-weight: 700 }
.sketch, .map { fill: #222 } .sketch { width: 100%; height: auto } .map { width: 100%; height: auto }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 20px } .pair h4 { margin: 6px 0 4px; font-size: 14px }
.photos { display: grid; grid-template-columns: repeat(auto-fill, minmax(480px, 1fr)); gap: 14px } figure { margin: 0 } figcaption { font-size: 13px; overflow-wrap: anywhere }
.photos img { width: 100%; display: block; cursor: zoom-in } .photos input { position: absolute; opacity: 0 }
.photos input:focus-visible + img { outline: 3px solid #1565c0 }
figure:has(input:checked) { grid-column: 1 / -1 } figure:has(input:checked) img { cursor: zoom-out }
.key span { margin-right: 18px; display: inline-block } small { color: #555 }
@media print { h2 { break-before: page } figure, svg { break-inside: avoid } }
)";

}

std::string PageHead(bool loads_itself, const std::string& more_styles)
{
	std::string head = HEAD + more_styles + "</style></head><body>\n";
	if (loads_itself)
		head.insert(head.find("<title>"), "<meta http-equiv=\"refresh\" content=\"5\"/>");
	return head;
}

}
