//! A small chart in Mermaid, which GitHub draws.

use crate::parts::Report;

/// Bars of the chart.
const BARS: usize = 24;

/// How many findings there are along the program; `None` where fewer than two are at a time.
pub(super) fn over_time(report: &Report) -> Option<String> {
    let total_s = report.totals.time_s.filter(|&total_s| total_s > 0.0)?;
    let mut bars = [0_usize; BARS];
    let times_s = report.findings.iter().filter_map(|finding| finding.time_s);
    for time_s in times_s {
        let bar = (time_s / total_s * BARS as f64).floor().clamp(0.0, (BARS - 1) as f64);
        bars[bar as usize] += 1;
    }
    let (count, most) = (bars.iter().sum::<usize>(), bars.iter().max()?);
    if count < 2 {
        return None;
    }
    let bars: Vec<String> = bars.iter().map(usize::to_string).collect();
    Some(format!(
        "```mermaid\nxychart-beta\n    title \"findings along the program\"\n    x-axis \"time, min\" 0 --> {:.3}\n    \
         y-axis \"findings\" 0 --> {most}\n    bar [{}]\n```\n",
        total_s / 60.0,
        bars.join(", ")
    ))
}
