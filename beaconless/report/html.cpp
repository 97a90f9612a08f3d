// SPDX-License-Identifier: Apache-2.0
#include "beaconless/report/html.hpp"

#include <iterator>

#include <fmt/format.h>

#include "beaconless/report/text.hpp"

namespace beaconless::report {
namespace {

constexpr std::size_t kLongestText = 200'000;

constexpr std::string_view kStyle = R"(
:root{--paper:#fff;--page:#f4f5f7;--ink:#1c2330;--soft:#5a6372;--rule:#dfe3e8;--good:#00875f;--mixed:#b86e00;--bad:#b3122b}
@media screen and (prefers-color-scheme:dark){
:root{--paper:#14181f;--page:#0c0f14;--ink:#e4e7ec;--soft:#a3abb8;--rule:#2a313c;--good:#3ecb9c;--mixed:#f5b13d;--bad:#ff6f73}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%;text-size-adjust:100%}
body{margin:0;background:var(--page);color:var(--ink);font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
main{max-width:1200px;margin:0 auto;padding:28px 24px 48px}
h1{font-size:26px;line-height:1.2;margin:0;overflow-wrap:anywhere}
h2{font-size:18px;margin:32px 0 12px}
.subtitle{color:var(--soft);margin:4px 0 18px;overflow-wrap:anywhere}
.verdict{display:flex;gap:14px;align-items:center;background:var(--paper);border:1px solid var(--rule);border-left:6px solid;border-radius:6px;padding:14px 18px;margin:0 0 16px}
.verdict p{margin:0;font-size:18px;line-height:1.4;color:var(--ink);font-weight:600;overflow-wrap:anywhere}
.verdict b{font-size:24px;line-height:1}
.good{color:var(--good)}.mixed{color:var(--mixed)}.bad{color:var(--bad)}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(165px,1fr));gap:12px;margin:0 0 16px;padding:0}
.card,figure,.table,details,.list{background:var(--paper);border:1px solid var(--rule);border-radius:6px}
.card{padding:12px 16px;min-width:0}
.card dt{color:var(--soft);font-size:13px}
.card dd{margin:0}
.card .value{font-size:26px;line-height:1.25;font-weight:650;font-variant-numeric:tabular-nums;white-space:nowrap}
.card .value small{font-size:15px;font-weight:400;color:var(--soft);margin-left:4px}
.card .note{color:var(--soft);font-size:13px;line-height:1.35}
.row{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:12px;margin:0 0 12px}
figure{margin:0 0 12px;padding:14px 16px 12px;min-width:0;break-inside:avoid}
.row figure{margin:0}
figure>svg{width:100%;height:auto}
.row .pic:not(.mark){font-size:15px}
figcaption{color:var(--soft);font-size:13.5px;line-height:1.4;margin-top:4px}
.legend{display:flex;flex-wrap:wrap;gap:2px 18px;list-style:none;margin:4px 0 0;padding:0;font-size:13.5px}
.legend li{display:flex;align-items:center;gap:6px}
.mark{flex:none}
.table{overflow-x:auto;width:fit-content;max-width:100%;margin:0 0 12px;break-inside:avoid}
table{border-collapse:collapse;min-width:320px;font-variant-numeric:tabular-nums}
caption{text-align:left;padding:12px 12px 6px;font-weight:600}
th,td{padding:6px 12px;text-align:right;white-space:nowrap}
th{color:var(--soft);font-weight:500;font-size:13px;border-bottom:1px solid var(--rule)}
tbody tr+tr>*{border-top:1px solid var(--rule)}
th:first-child,td:first-child{text-align:left}
details{margin:0 0 12px;padding:0 16px}
summary{cursor:pointer;padding:10px 0;font-weight:600}
pre{margin:0 0 12px;white-space:pre-wrap;overflow-wrap:anywhere;font:12.5px/1.5 ui-monospace,"SF Mono",Menlo,Consolas,"DejaVu Sans Mono",monospace}
.list{margin:0 0 12px;padding:10px 16px 10px 34px;overflow-wrap:anywhere}
@media (max-width:860px){.row{grid-template-columns:minmax(0,1fr)}}
@media (max-width:560px){
main{padding:18px 10px 32px}h1{font-size:21px}.verdict{padding:12px}.verdict p{font-size:16px}
.cards{grid-template-columns:repeat(2,minmax(0,1fr));gap:8px}.card{padding:10px 12px}.card .value{font-size:22px}
figure{padding:10px 8px}th,td{padding:6px 10px}
.row .pic:not(.mark){font-size:21px}.wide .pic:not(.mark){font-size:27px}}
@media print{body{background:none;font-size:11pt}main{max-width:none;padding:0}h2{break-after:avoid}}
)";

std::string_view name_of(Verdict verdict) {
  return verdict == Verdict::good ? "good" : verdict == Verdict::mixed ? "mixed" : "bad";
}

std::string_view sign_of(Verdict verdict) {
  return verdict == Verdict::good ? "✓" : verdict == Verdict::mixed ? "!" : "✗";
}

/// At most kLongestText bytes, with a word on what was left out.
std::string shortened(std::string_view text) {
  if (text.size() <= kLongestText) return escaped(text);
  return escaped(text.substr(0, kLongestText)) +
         fmt::format("\n… {} more bytes", grouped(text.size() - kLongestText));
}

}  // namespace

Page::Page(std::string title, std::string subtitle)
    : title_(std::move(title)), subtitle_(std::move(subtitle)) {}

void Page::verdict(Verdict verdict, std::string_view words) {
  fmt::format_to(std::back_inserter(body_),
                 "<div class=\"verdict {}\"><b aria-hidden=\"true\">{}</b><p>{}</p></div>\n",
                 name_of(verdict), sign_of(verdict), escaped(words));
}

void Page::cards(const std::vector<Card>& cards) {
  body_ += "<dl class=\"cards\">\n";
  for (const Card& card : cards)
    fmt::format_to(std::back_inserter(body_),
                   "<div class=\"card\"><dt>{}</dt><dd class=\"value\">{}<small>{}</small></dd>"
                   "<dd class=\"note\">{}</dd></div>\n",
                   escaped(card.name), escaped(card.value), escaped(card.unit), escaped(card.note));
  body_ += "</dl>\n";
}

void Page::heading(std::string_view words) { body_ += "<h2>" + escaped(words) + "</h2>\n"; }

void Page::figure(const Picture& picture, std::string_view caption) {
  fmt::format_to(std::back_inserter(body_), "<figure class=\"{}\">\n{}",
                 picture.width_px > 800.0 ? "wide" : "narrow", svg_inline(picture));
  if (!picture.legend.empty()) {
    body_ += "<ul class=\"legend\">\n";
    for (const LegendEntry& entry : picture.legend)
      body_ += "<li>" + svg_inline(entry) + "<span>" + escaped(entry.text) + "</span></li>\n";
    body_ += "</ul>\n";
  }
  const std::string gap = caption.empty() || picture.note.empty() ? "" : " ";
  body_ += "<figcaption>" + escaped(caption) + gap + escaped(picture.note) + "</figcaption>\n</figure>\n";
}

void Page::begin_row() { body_ += "<div class=\"row\">\n"; }
void Page::end_row() { body_ += "</div>\n"; }

void Page::table(const Table& table) {
  body_ += "<div class=\"table\"><table>\n";
  if (!table.caption.empty()) body_ += "<caption>" + escaped(table.caption) + "</caption>\n";
  body_ += "<thead><tr>";
  for (const std::string& column : table.columns) body_ += "<th scope=\"col\">" + escaped(column) + "</th>";
  body_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    body_ += "<tr>";
    for (const std::string& cell : row) body_ += "<td>" + escaped(cell) + "</td>";
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void Page::list(const std::vector<std::string>& items) {
  if (items.empty()) return;
  body_ += "<ul class=\"list\">\n";
  for (const std::string& item : items) body_ += "<li>" + shortened(item) + "</li>\n";
  body_ += "</ul>\n";
}

void Page::paragraph(std::string_view words) { body_ += "<p>" + escaped(words) + "</p>\n"; }

void Page::details(std::string_view summary, std::string_view text, bool open) {
  fmt::format_to(std::back_inserter(body_), "<details{}><summary>{}</summary>\n<pre>{}</pre></details>\n",
                 open ? " open=\"open\"" : "", escaped(summary), shortened(text));
}

std::string Page::html() const {
  // The policy is a promise the browser keeps: nothing is fetched, nothing is run.
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<meta name=\"color-scheme\" content=\"light "
      "dark\"/>\n<title>{0}</title>\n<style>{1}{2}</style>\n</head>\n"
      "<body><main>\n<h1>{0}</h1>\n<p class=\"subtitle\">{3}</p>\n{4}</main></body>\n</html>\n",
      escaped(title_), picture_css(), kStyle, escaped(subtitle_), body_);
}

}  // namespace beaconless::report
