#include "renders/html.hpp"

namespace drycut::renders {

const char* const kReportStyle = R"css(
:root { color-scheme: light dark;
  --ground: #f5f6f8; --card: #ffffff; --ink: #1c242c; --soft: #5b6875; --line: #dde2e7; --head: #eef1f4;
  --pass: #156f3d; --pass-ground: #e2f4e9; --fail: #b3261e; --fail-ground: #fdeae8; --accent: #b45309; }
@media (prefers-color-scheme: dark) { :root {
  --ground: #12161a; --card: #1b2126; --ink: #e8ecf0; --soft: #9aa7b3; --line: #313a42; --head: #232a31;
  --pass: #6fd49a; --pass-ground: #14301f; --fail: #ff9a91; --fail-ground: #3c1a18; --accent: #f0a35e; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
  font: 16px/1.5 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
main { max-width: 1240px; margin: 0 auto; padding: 24px 20px 64px; }
header { border-bottom: 3px solid var(--accent); margin-bottom: 22px; padding-bottom: 12px; }
h1 { font-size: 1.75rem; line-height: 1.2; margin: 0 0 4px; text-wrap: balance; }
h2 { font-size: 1.2rem; margin: 34px 0 12px; }
.remark { margin: 0 0 6px; color: var(--soft); }
h2 small { color: var(--soft); font-weight: 400; font-size: 0.88rem; margin-left: 6px; }
header p { margin: 0; color: var(--soft); overflow-wrap: anywhere; }
.verdict { display: flex; flex-wrap: wrap; align-items: center; gap: 8px 18px; margin: 0; padding: 16px 20px;
  border-radius: 10px; border-left: 8px solid; font-size: 1.15rem; }
.verdict strong { font-size: 1.6rem; letter-spacing: 0.05em; }
.verdict.pass { color: var(--pass); background: var(--pass-ground); border-color: var(--pass); }
.verdict.fail { color: var(--fail); background: var(--fail-ground); border-color: var(--fail); }
.verdict.told { color: var(--accent); background: var(--card); border-color: var(--accent); }
.verdict span { color: var(--ink); overflow-wrap: anywhere; }
dl.facts { display: flex; flex-wrap: wrap; gap: 1px; margin: 20px 0 0; background: var(--line);
  border: 1px solid var(--line); border-radius: 10px; overflow: hidden; }
dl.facts div { flex: 1 1 160px; background: var(--card); padding: 8px 14px; }
dt { color: var(--soft); font-size: 0.82rem; }
dd { margin: 0; overflow-wrap: anywhere; font-variant-numeric: tabular-nums; }
/* A shadow at the side where there is more to see. */
.scroll { overflow: auto; max-height: 30rem;
  background: linear-gradient(to right, var(--card) 40%, transparent) 0 0 / 40px 100% local no-repeat,
    linear-gradient(to left, var(--card) 40%, transparent) 100% 0 / 40px 100% local no-repeat,
    linear-gradient(to right, #0004, transparent) 0 0 / 12px 100% scroll no-repeat,
    linear-gradient(to left, #0004, transparent) 100% 0 / 12px 100% scroll no-repeat, var(--card); border: 1px solid var(--line);
  border-radius: 10px; }
.scroll.checks { max-height: none; }
table { border-collapse: collapse; width: 100%; font-size: 0.92rem; font-variant-numeric: tabular-nums; }
th, td { padding: 7px 14px; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
tr:last-child td { border-bottom: 0; }
thead th { position: sticky; top: 0; background: var(--head); white-space: nowrap; font-weight: 600; }
td.number { text-align: right; white-space: nowrap; }
th.number { text-align: right; }
.badge { display: inline-block; padding: 1px 10px; border-radius: 99px; font-weight: 700; font-size: 0.92em;
  white-space: nowrap; }
.badge.pass { color: var(--pass); background: var(--pass-ground); }
.badge.fail { color: var(--fail); background: var(--fail-ground); }
tr.fail td { background: color-mix(in srgb, var(--fail-ground) 45%, transparent); }
td code { font-size: 0.95em; overflow-wrap: anywhere; }
td small { display: block; color: var(--soft); }
.strip { display: grid; grid-template-columns: repeat(auto-fill, minmax(400px, 1fr)); gap: 14px; }
figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: 10px; overflow: hidden;
  break-inside: avoid; }
figure.film { max-width: 960px; margin-bottom: 16px; }
figure video { display: block; width: 100%; height: auto; background: #1b2026; }
figure img { display: block; width: 100%; height: auto; }
figcaption { padding: 6px 12px 8px; color: var(--soft); font-size: 0.88rem; overflow-wrap: anywhere; }
figure.plot { margin-bottom: 16px; }
figure.plot .ground { background: #ffffff; overflow-x: auto; }
figure.plot.is-live .ground { display: none; }
.live { padding: 12px 14px 8px; }
.live-head { display: flex; flex-wrap: wrap; align-items: baseline; gap: 6px 16px; margin-bottom: 8px; }
.live-head strong { font-size: 1.05rem; }
.live-head button { font: inherit; font-size: 0.82rem; color: var(--ink); background: var(--head);
  border: 1px solid var(--line); border-radius: 6px; padding: 1px 10px; cursor: pointer; }
.live-x { color: var(--soft); font-size: 0.88rem; font-variant-numeric: tabular-nums; }
.live-legend { display: flex; flex-wrap: wrap; gap: 0 18px; font-size: 0.88rem; min-height: 1.4em; margin-top: 4px; }
.live-entry i { display: inline-block; width: 22px; height: 3px; vertical-align: middle; margin-right: 6px; }
.live-entry i.points { width: 7px; height: 7px; border-radius: 50%; }
.live-entry output { display: inline-block; min-width: 6.5em; font-variant-numeric: tabular-nums; }
.live-band { color: var(--soft); }
.live-band::before { content: ""; display: inline-block; width: 22px; border-top: 2px dashed var(--fail);
  vertical-align: middle; margin-right: 6px; }
.live-canvas { position: relative; width: 100%; touch-action: pan-y; }
.live-cursor { position: absolute; top: 0; bottom: 0; width: 0; border-left: 1px solid var(--soft); display: none;
  pointer-events: none; z-index: 20; }
.live-hint { margin: 4px 0 0; color: var(--soft); font-size: 0.8rem; }
.live .dygraph-axis-label { color: var(--soft); }
.live .dygraph-axis-label-y { white-space: nowrap; overflow: hidden; text-overflow: ellipsis; }
details { margin-top: 14px; background: var(--card); border: 1px solid var(--line); border-radius: 10px; }
summary { padding: 10px 16px; cursor: pointer; font-weight: 600; }
summary small { color: var(--soft); font-weight: 400; margin-left: 8px; }
details .scroll { border: 0; border-top: 1px solid var(--line); border-radius: 0 0 10px 10px; }
pre { margin: 0; padding: 14px 16px; font: 13px/1.5 ui-monospace, "DejaVu Sans Mono", monospace; tab-size: 2; }
@media (max-width: 640px) {
  main { padding: 14px 12px 40px; }
  h1 { font-size: 1.35rem; }
  .verdict { padding: 12px 14px; font-size: 1rem; }
  .verdict strong { font-size: 1.3rem; }
  dl.facts div { flex-basis: 45%; }
  .strip { grid-template-columns: none; grid-auto-flow: column; grid-auto-columns: 88%; overflow-x: auto;
    scroll-snap-type: x mandatory; }
  .strip figure { scroll-snap-align: start; }
  figure.plot img { min-width: 680px; }
  th, td { padding: 6px 8px; }
  table:not(.checks) { font-size: 0.82rem; }
  /* A check becomes a card: a wide table is not read on a phone. */
  table.checks thead { display: none; }
  table.checks tr { display: block; padding: 8px 0; border-bottom: 1px solid var(--line); }
  table.checks tr:last-child { border-bottom: 0; }
  table.checks td { display: block; border: 0; padding: 2px 14px; }
  table.checks td[data-of] { padding-left: 28px; }
  table.checks td[data-of]:empty { display: none; }
  table.checks td[data-of]::before { content: attr(data-of) " "; color: var(--soft); }
}
@media print {
  :root { color-scheme: light; --ground: #fff; --card: #fff; --ink: #000; --soft: #444; --line: #bbb; --head: #eee;
    --pass: #156f3d; --pass-ground: #e2f4e9; --fail: #b3261e; --fail-ground: #fdeae8; --accent: #b45309; }
  body { font-size: 10.5pt; }
  main { max-width: none; padding: 0; }
  .scroll { max-height: none; overflow: visible; background: none; }
  table { font-size: 8.5pt; }
  th, td { padding: 2px 7px; }
  th, td { overflow-wrap: anywhere; }
  td:not(.number) { min-width: 5em; }
  table:has(th:nth-child(7)) { font-size: 7pt; }
  thead th, td.number { white-space: normal; }
  pre { font-size: 7.5pt; overflow-wrap: anywhere; }
  .strip { grid-template-columns: repeat(2, 1fr); }
  figure.film, .live { display: none; }
  figure.plot.is-live .ground { display: block; }
  .verdict, .badge { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  tr, figure { break-inside: avoid; }
  h2 { break-after: avoid; }
  thead th { position: static; }
  pre { white-space: pre-wrap; }
  details::details-content { content-visibility: visible; block-size: auto; }
}
)css";

}  // namespace drycut::renders
