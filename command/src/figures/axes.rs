//! A panel: a frame with axes, and curves and marks inside it.

use super::style::{BLACK, GREY, LABEL, Line, PAGE, SMALL, solid};
use super::svg::{Anchor, At, Page, Rectangle};

#[derive(Debug, Clone)]
pub(super) struct Axis {
    label: String,
    low: f64,
    high: f64,
    logarithmic: bool,
    numbers: bool,
    /// Numbers are written in full, with no power of ten taken out.
    in_full: bool,
}

impl Axis {
    pub(super) fn linear(label: &str, low: f64, high: f64) -> Self {
        Self { label: label.to_owned(), low, high, logarithmic: false, numbers: true, in_full: false }
    }

    pub(super) fn logarithmic(label: &str, low: f64, high: f64) -> Self {
        Self { logarithmic: true, ..Self::linear(label, low, high) }
    }

    /// A linear axis that holds all `values` with some room on either side.
    pub(super) fn around(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let size = low.abs().max(high.abs());
        // A constant is drawn as one: its rounding is not spread over the frame.
        let room = match high - low > 1e-3 * size {
            true => 0.06 * (high - low),
            false if size > 0.0 => 0.05 * size,
            false => 1.0,
        };
        Self::linear(label, low - room, high + room)
    }

    /// The same axis with its numbers in full, as dates are read.
    pub(super) fn in_full(self) -> Self {
        Self { in_full: true, ..self }
    }

    /// The same axis with ticks but neither numbers nor a label, where the panel below has them.
    pub(super) fn bare(&self) -> Self {
        Self { label: String::new(), numbers: false, ..self.clone() }
    }

    /// The same axis without numbers, where there is nothing to read off.
    pub(super) fn unnumbered(&self) -> Self {
        Self { numbers: false, ..self.clone() }
    }

    /// The same axis without its label.
    pub(super) fn unnamed(&self) -> Self {
        Self { label: String::new(), ..self.clone() }
    }

    fn place(&self, value: f64) -> f64 {
        let scale = |x: f64| if self.logarithmic { x.log10() } else { x };
        (scale(value) - scale(self.low)) / (scale(self.high) - scale(self.low))
    }

    /// Power of ten that is taken out of the numbers at the ticks, to keep them short.
    fn power(&self) -> i32 {
        let size = self.low.abs().max(self.high.abs()).log10();
        if self.logarithmic || self.in_full || (-2.0..4.0).contains(&size) { 0 } else { size.floor() as i32 }
    }

    /// The label, with the power of ten that its numbers lack.
    fn full_label(&self) -> String {
        let power = self.power();
        if power == 0 || self.label.is_empty() {
            return self.label.clone();
        }
        let power = power_of_ten(power);
        match self.label.strip_suffix(']').and_then(|label| label.rsplit_once('[')) {
            Some((quantity, unit)) => format!("{quantity}[{power} {unit}]"),
            None => format!("{} / {power}", self.label),
        }
    }

    /// Large ticks with their numbers, and small ones, of an axis of this length with one number each `spacing`.
    fn ticks(&self, length: f64, spacing: f64) -> (Vec<(f64, String)>, Vec<f64>) {
        if self.logarithmic { self.decades(length, spacing) } else { self.steps(length, spacing) }
    }

    fn steps(&self, length: f64, spacing: f64) -> (Vec<(f64, String)>, Vec<f64>) {
        let range = self.high - self.low;
        let rough = range * spacing / length;
        let power = 10f64.powf(rough.log10().floor());
        let (digit, parts) = [(1.0, 5), (2.0, 4), (5.0, 5), (10.0, 5)]
            .into_iter()
            .find(|(m, _)| m * power >= rough)
            .unwrap_or((10.0, 5));
        let step = digit * power;
        let unit = 10f64.powi(self.power());
        let decimals = (-(step / unit * 1.0000001).log10().floor()).max(0.0) as usize;
        let multiples = |step: f64| {
            let slack = 1e-9 * range;
            let first = ((self.low - slack) / step).ceil() as i64;
            let last = ((self.high + slack) / step).floor() as i64;
            (first..=last).map(move |i| i as f64 * step)
        };
        let large: Vec<_> =
            multiples(step).map(|value| (value, signed(&format!("{:.decimals$}", value / unit)))).collect();
        // One number alone gives no scale.
        if large.len() < 2 && spacing > 8.0 {
            return self.steps(length, spacing / 2.0);
        }
        (large, multiples(step / f64::from(parts)).collect())
    }

    fn decades(&self, length: f64, spacing: f64) -> (Vec<(f64, String)>, Vec<f64>) {
        let (first, last) = (self.low.log10(), self.high.log10());
        let every = ((last - first) * spacing / length).ceil().max(1.0) as i32;
        let decades = (first - 1e-9).ceil() as i32..=(last + 1e-9).floor() as i32;
        let large = decades.clone().filter(|n| n % every == 0);
        let large = large.map(|n| (10f64.powi(n), power_of_ten(n))).collect();
        let all = (decades.start() - 1..=*decades.end()).flat_map(|n| {
            let digits = if every > 1 { 1..=1 } else { 1..=9 };
            digits.map(move |m| f64::from(m) * 10f64.powi(n))
        });
        (large, all.filter(|x| (self.low..=self.high).contains(x)).collect())
    }
}

/// `10^{−3}`.
pub(super) fn power_of_ten(power: i32) -> String {
    format!("10^{{{}}}", signed(&power.to_string()))
}

/// A number with a minus sign in place of the hyphen, and no sign on a zero.
pub(super) fn signed(number: &str) -> String {
    match number.strip_prefix('-') {
        Some(digits) if digits.chars().any(|c| c.is_ascii_digit() && c != '0') => format!("\u{2212}{digits}"),
        Some(zero) => zero.to_owned(),
        None => number.to_owned(),
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Mark {
    Disc,
    Ring,
}

#[derive(Debug, Clone)]
pub(super) struct Panel {
    pub(super) frame: Rectangle,
    pub(super) x: Axis,
    pub(super) y: Axis,
    /// Distance of the label of the y axis from the frame.
    pub(super) y_label_distance: f64,
}

/// Room that a panel needs around its frame for numbers and labels.
pub(super) const LEFT: f64 = 42.0;
pub(super) const BELOW: f64 = 29.0;

/// Panels of one size in columns and rows.
pub(super) struct Grid {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
    /// Distances between columns and between rows.
    pub(super) between: [f64; 2],
}

impl Grid {
    /// Two panels over one another for each of some subjects, side by side.
    pub(super) fn two_rows(columns: usize, height: f64, between: f64) -> Self {
        let count = columns as f64;
        let width = (PAGE - LEFT - 8.0 - (count - 1.0) * between) / count;
        Self { left: LEFT, top: 18.0, width, height, between: [between, 8.0] }
    }

    pub(super) fn frame(&self, column: usize, row: usize) -> Rectangle {
        let Self { width, height, between: [across, down], .. } = *self;
        let (left, top) = (self.left + (width + across) * column as f64, self.top + (height + down) * row as f64);
        Rectangle { left, top, width, height }
    }

    /// The lower end of some rows.
    pub(super) fn bottom(&self, rows: usize) -> f64 {
        self.top + rows as f64 * self.height + (rows as f64 - 1.0) * self.between[1]
    }
}

impl Panel {
    pub(super) fn new(frame: Rectangle, x: Axis, y: Axis) -> Self {
        Self { frame, x, y, y_label_distance: 29.0 }
    }

    /// Power of ten that is taken out of the numbers at the y axis.
    pub(super) fn y_power(&self) -> i32 {
        self.y.power()
    }

    pub(super) fn at(&self, x: f64, y: f64) -> At {
        let f = &self.frame;
        [f.left + self.x.place(x) * f.width, f.bottom() - self.y.place(y) * f.height]
    }

    /// A curve, cut off at the frame.
    pub(super) fn curve(&self, page: &mut Page, points: &[(f64, f64)], line: Line) {
        let points: Vec<_> = points.iter().map(|&(x, y)| self.at(x, y)).collect();
        page.clipped(self.frame, |page| page.path(&points, line));
    }

    /// A horizontal line through the frame.
    pub(super) fn level(&self, page: &mut Page, y: f64, line: Line) {
        page.path(&[self.at(self.x.low, y), self.at(self.x.high, y)], line);
    }

    /// A vertical line through the frame.
    pub(super) fn upright(&self, page: &mut Page, x: f64, line: Line) {
        page.path(&[self.at(x, self.y.low), self.at(x, self.y.high)], line);
    }

    pub(super) fn marks(&self, page: &mut Page, points: &[(f64, f64)], mark: Mark, size: f64, colour: &'static str) {
        for &(x, y) in points {
            draw_mark(page, self.at(x, y), mark, size, colour);
        }
    }

    /// Words in the middle of a frame that holds nothing.
    pub(super) fn remark(&self, page: &mut Page, words: &str) {
        let Rectangle { left, top, width, height } = self.frame;
        page.text([left + width / 2.0, top + height / 2.0], Anchor::Middle, SMALL, GREY, words);
    }

    /// Frame, ticks, numbers and labels: after the curves.
    pub(super) fn draw_frame(&self, page: &mut Page) {
        let f = self.frame;
        let line = solid(BLACK, 0.6);
        page.outline(f, line);
        let (large, small) = self.x.ticks(f.width, 34.0);
        for (value, length) in large.iter().map(|(v, _)| (*v, 3.5)).chain(small.iter().map(|v| (*v, 2.0))) {
            let x = f.left + self.x.place(value) * f.width;
            page.path(&[[x, f.bottom()], [x, f.bottom() - length]], line);
            page.path(&[[x, f.top], [x, f.top + length]], line);
        }
        if self.x.numbers {
            for (value, number) in &large {
                let x = f.left + self.x.place(*value) * f.width;
                page.text([x, f.bottom() + 11.5], Anchor::Middle, SMALL, BLACK, number);
            }
        }
        page.label([f.left + f.width / 2.0, f.bottom() + 23.0], Anchor::Middle, &self.x.full_label());

        let (large, small) = self.y.ticks(f.height, 16.0);
        for (value, length) in large.iter().map(|(v, _)| (*v, 3.5)).chain(small.iter().map(|v| (*v, 2.0))) {
            let y = f.bottom() - self.y.place(value) * f.height;
            page.path(&[[f.left, y], [f.left + length, y]], line);
            page.path(&[[f.right(), y], [f.right() - length, y]], line);
        }
        if self.y.numbers {
            for (value, number) in &large {
                let y = f.bottom() - self.y.place(*value) * f.height;
                page.text([f.left - 3.0, y + 0.35 * SMALL], Anchor::End, SMALL, BLACK, number);
            }
        }
        // Digits are 0.556 of the size of the letters wide.
        let widest = large.iter().map(|(_, number)| 0.556 * SMALL * super::plain(number).chars().count() as f64);
        let x =
            f.left - self.y_label_distance.max(9.0 + if self.y.logarithmic { 0.0 } else { widest.fold(0.0, f64::max) });
        page.turned_text([x, f.top + f.height / 2.0], -90.0, Anchor::Middle, LABEL, BLACK, &self.y.full_label());
    }

    /// The letter of panel number `index` of `count`, above its left edge, with what tells it from the others.
    pub(super) fn letter(&self, page: &mut Page, index: usize, count: usize, what: &str) {
        let at = [self.frame.left, self.frame.top - 4.5];
        if count > 1 {
            heading(page, at, char::from(b'a' + index as u8), what)
        } else {
            page.label(at, Anchor::Start, what)
        }
    }
}

/// `(a)` in bold and what follows it.
pub(super) fn heading(page: &mut Page, at: At, letter: char, what: &str) {
    page.label(at, Anchor::Start, format!("**({letter})** {what}").trim_end());
}

pub(super) fn draw_mark(page: &mut Page, [x, y]: At, mark: Mark, size: f64, colour: &'static str) {
    match mark {
        Mark::Disc => page.circle([x, y], size, colour, None),
        Mark::Ring => page.circle([x, y], size, "#ffffff", Some(solid(colour, 0.9))),
    }
}
