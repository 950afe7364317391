//! Legends of lines and marks.

use super::axes::{Mark, draw_mark};
use super::style::{BLACK, GREY, Line, SMALL, solid};
use super::svg::{Anchor, At, Page, Rectangle};

#[derive(Debug, Clone, Copy)]
pub(super) enum Sample {
    Line(Line),
    Mark(Mark, &'static str),
}

const SAMPLE: f64 = 20.0;

/// Names below one another, the first at `at`.
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

/// Names to the right of a frame, as close to the ends of their curves as there is room.
pub(super) fn name_ends(page: &mut Page, frame: Rectangle, mut ends: Vec<(At, String, &'static str)>) {
    const APART: f64 = 9.6;
    ends.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
    // From the top downwards; names below the frame then move up again.
    let mut heights: Vec<f64> = ends.iter().map(|(at, ..)| at[1]).collect();
    for k in 1..heights.len() {
        heights[k] = heights[k].max(heights[k - 1] + APART);
    }
    let mut most = frame.bottom();
    for height in heights.iter_mut().rev() {
        *height = height.min(most);
        most = *height - APART;
    }
    for (([x, y], name, colour), height) in ends.into_iter().zip(heights) {
        page.path(&[[x + 1.0, y], [x + 8.0, height]], solid(GREY, 0.5));
        page.text([x + 10.0, height + 0.35 * SMALL], Anchor::Start, SMALL, colour, &name);
    }
}
