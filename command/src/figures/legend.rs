//! What lines and marks stand for.

use super::axes::{Mark, draw_mark};
use super::style::{BLACK, Line, SMALL};
use super::svg::{Anchor, At, Page};

#[derive(Debug, Clone, Copy)]
pub(super) enum Sample {
    Line(Line),
    Mark(Mark, &'static str),
}

const SAMPLE: f64 = 20.0;

/// Names under one another, the first at `at`.
pub(super) fn legend(page: &mut Page, [x, y]: At, entries: &[(Sample, &str)]) {
    for (i, entry) in entries.iter().enumerate() {
        legend_entry(page, [x, y + 13.0 * i as f64], entry);
    }
}

/// Names side by side, each with its width on the page.
pub(super) fn legend_row(page: &mut Page, [x, y]: At, entries: &[(Sample, &str, f64)]) {
    let mut left = x;
    for &(sample, name, width) in entries {
        legend_entry(page, [left, y], &(sample, name));
        left += width;
    }
}

fn legend_entry(page: &mut Page, [x, y]: At, (sample, name): &(Sample, &str)) {
    let middle = y - 0.35 * SMALL;
    match *sample {
        Sample::Line(line) => page.path(&[[x, middle], [x + SAMPLE, middle]], line),
        Sample::Mark(mark, colour) => draw_mark(page, [x + SAMPLE / 2.0, middle], mark, 2.0, colour),
    }
    page.text([x + SAMPLE + 4.0, y], Anchor::Start, SMALL, BLACK, name);
}
