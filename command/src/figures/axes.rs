//! A panel: a frame with axes that contains curves and marks.

use super::style::{BLACK, GREY, LABEL, Line, PAGE, SMALL, solid};
use super::svg::{Anchor, At, Page, Rectangle};

#[derive(Debug, Clone)]
pub(super) struct Axis {
    label: String,
    low: f64,
    high: f64,
    logarithmic: bool,
    numbers: bool,
    /// Numbers are written in full, without a common power of ten.
    in_full: bool,
}

impl Axis {
    pub(super) fn linear(label: &str, low: f64, high: f64) -> Self {
        Self { label: label.to_owned(), low, high, logarithmic: false, numbers: true, in_full: false }
    }

    pub(super) fn logarithmic(label: &str, low: f64, high: f64) -> Self {
        Self { logarithmic: true, ..Self::linear(label, low, high) }
    }

    /// A linear axis that contains all `values` with some room on either side.
    pub(super) fn around(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let size = high.max(-low);
        // A constant is drawn as a constant: its rounding does not fill the frame.
        let room = match high - low > 1e-3 * size {
            true => 0.06 * (high - low),
            false if size > 0.0 => 0.05 * size,
            false => 1.0,
        };
        Self::linear(label, low - room, high + room)
    }

    /// The same axis with its numbers in full, as for dates.
    pub(super) fn in_full(self) -> Self {
        Self { in_full: true, ..self }
    }

    /// The same axis with ticks but neither numbers nor a label, if the panel below has them.
    pub(super) fn bare(&self) -> Self {
        Self { label: String::new(), numbers: false, ..self.clone() }
    }

    /// The same axis without numbers, if no values are read off.
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

    /// Power of ten that is factored out of the numbers at the ticks, to keep them short.
    fn power(&self) -> i32 {
        let size = self.high.max(-self.low).log10();
        if self.logarithmic || self.in_full || (-2.0..4.0).contains(&size) { 0 } else { size.floor() as i32 }
    }

    /// The label with the power of ten that is factored out.
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

    /// Large ticks with their numbers, and small ones, for an axis of this length with about one number per `spacing`.
    fn ticks(&self, length: f64, spacing: f64) -> (Vec<(f64, String)>, Vec<f64>) {
        if self.logarithmic { self.decades(length, spacing) } else { self.steps(length, spacing) }
    }

    fn steps(&self, length: f64, spacing: f64) -> (Vec<(f64, String)>, Vec<f64>) {
        let range = self.high - self.low;
        let rough = range * spacing / length;
        let power = 10f64.powf(rough.log10().floor());
        let digits = [(1.0, 5), (2.0, 4), (5.0, 5)];
        let (digit, parts) = digits.into_iter().find(|(m, _)| m * power >= rough).unwrap_or((10.0, 5));
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
        // A single number gives no scale.
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

/// As `10^{−3}`.
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

/// Room for numbers and labels around the frame of a panel.
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
    /// Two panels above one another for each subject, side by side.
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

    /// The lower end of `rows` rows.
    pub(super) fn bottom(&self, rows: usize) -> f64 {
        self.top + rows as f64 * self.height + (rows as f64 - 1.0) * self.between[1]
    }
}

impl Panel {
    pub(super) fn new(frame: Rectangle, x: Axis, y: Axis) -> Self {
        Self { frame, x, y, y_label_distance: 29.0 }
    }

    /// Power of ten that is factored out of the numbers at the y axis.
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

    /// Words in the middle of an empty frame.
    pub(super) fn remark(&self, page: &mut Page, words: &str) {
        let Rectangle { left, top, width, height } = self.frame;
        page.text([left + width / 2.0, top + height / 2.0], Anchor::Middle, SMALL, GREY, words);
    }

    /// Frame, ticks, numbers and labels, drawn after the curves.
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
        // A digit is 0.556 of the font size wide.
        let widest = large.iter().map(|(_, number)| 0.556 * SMALL * super::plain(number).chars().count() as f64);
        let x =
            f.left - self.y_label_distance.max(9.0 + if self.y.logarithmic { 0.0 } else { widest.fold(0.0, f64::max) });
        page.turned_text([x, f.top + f.height / 2.0], -90.0, Anchor::Middle, LABEL, BLACK, &self.y.full_label());
    }

    /// The letter of panel number `index` of `count`, above its left edge, with a heading that distinguishes it.
    pub(super) fn letter(&self, page: &mut Page, index: usize, count: usize, what: &str) {
        let at = [self.frame.left, self.frame.top - 4.5];
        if count > 1 {
            heading(page, at, char::from(b'a' + index as u8), what)
        } else {
            page.label(at, Anchor::Start, what)
        }
    }
}

/// `(a)` in bold with the text after it.
pub(super) fn heading(page: &mut Page, at: At, letter: char, what: &str) {
    page.label(at, Anchor::Start, format!("**({letter})** {what}").trim_end());
}

pub(super) fn draw_mark(page: &mut Page, [x, y]: At, mark: Mark, size: f64, colour: &'static str) {
    match mark {
        Mark::Disc => page.circle([x, y], size, colour, None),
        Mark::Ring => page.circle([x, y], size, "#ffffff", Some(solid(colour, 0.9))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places of the large and the small ticks, and the numbers at the large ones.
    fn ticks(axis: &Axis, length: f64, spacing: f64) -> (Vec<f64>, Vec<f64>, Vec<String>) {
        let (large, small) = axis.ticks(length, spacing);
        let (places, numbers) = large.into_iter().unzip();
        (places, small, numbers)
    }

    fn assert_near(found: &[f64], expected: &[f64]) {
        assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found:e} {expected:e}");
        }
    }

    fn multiples(step: f64, last: i32) -> Vec<f64> {
        (0..=last).map(|i| step * f64::from(i)).collect()
    }

    /// The step of the numbers is 1, 2, 5 or 10 times a power of ten and at least the requested distance, with five small ones in it, or four for 2.
    #[test]
    fn numbers_stand_at_round_steps() {
        for (high, spacing, step, small, numbers) in [
            (10.0, 10.0, 1.0, 0.2, "0 1 2 3 4 5 6 7 8 9 10"),
            (10.0, 20.0, 2.0, 0.5, "0 2 4 6 8 10"),
            (10.0, 30.0, 5.0, 1.0, "0 5 10"),
            (10.0, 60.0, 10.0, 2.0, "0 10"),
            (1000.0, 20.0, 200.0, 50.0, "0 200 400 600 800 1000"),
            (1.0, 30.0, 0.5, 0.1, "0.0 0.5 1.0"),
            (0.02, 50.0, 0.01, 0.002, "0.00 0.01 0.02"),
        ] {
            let (places, small_places, found) = ticks(&Axis::linear("x", 0.0, high), 100.0, spacing);
            assert_near(&places, &multiples(step, (high / step).round() as i32));
            assert_near(&small_places, &multiples(small, (high / small).round() as i32));
            assert_eq!(found.join(" "), numbers);
        }
    }

    /// Below 0.01 and from 1e4 on, numbers have a common power of ten, except for dates.
    #[test]
    fn long_numbers_are_written_by_a_power_of_ten() {
        let axis = Axis::linear("t [s]", 0.0, 2e4);
        assert_eq!(ticks(&axis, 100.0, 20.0).2, ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        assert_eq!(axis.full_label(), "t [10^{4} s]");
        let small = Axis::linear("x", -2e-3, 1e-3);
        assert_eq!(ticks(&small, 100.0, 30.0).2, ["\u{2212}2", "\u{2212}1", "0", "1"]);
        assert_eq!(small.full_label(), "x / 10^{\u{2212}3}");
        assert_eq!(Axis::linear("", 0.0, 2e4).full_label(), "");
        let dates = axis.in_full();
        assert_eq!(
            (ticks(&dates, 100.0, 50.0).2.join(" "), dates.full_label()),
            ("0 10000 20000".into(), "t [s]".into())
        );
        for (low, high, power) in
            [(0.0, 0.01, 0), (0.0, 0.0099, -3), (0.0, 9999.0, 0), (-1e4, 0.0, 4), (0.0, 2.5e-3, -3)]
        {
            assert_eq!(Axis::linear("x", low, high).power(), power, "{high}");
        }
        assert_eq!(Axis::logarithmic("x", 1e-9, 1e9).power(), 0);
    }

    /// An end of the axis has its tick if it is a round number within rounding, and none beside it.
    #[test]
    fn ends_have_ticks_where_they_are_round() {
        let (low, high) = (0.1 + 0.2, 0.7_f64.next_down());
        assert_eq!(ticks(&Axis::linear("x", low, high), 100.0, 25.0).2, ["0.3", "0.4", "0.5", "0.6", "0.7"]);
        let beside = Axis::linear("x", 0.3 + 3e-8, 0.7 - 3e-8);
        assert_eq!(ticks(&beside, 100.0, 25.0).2, ["0.4", "0.5", "0.6"]);
        let decades = |low: f64, high: f64| ticks(&Axis::logarithmic("x", low, high), 100.0, 10.0).0;
        assert_near(&decades(1e-3 * (1.0 + 1e-12), 10.0 * (1.0 - 1e-12)), &[1e-3, 1e-2, 0.1, 1.0, 10.0]);
        assert_near(&decades(1e-3 * (1.0 + 1e-7), 10.0 * (1.0 - 1e-7)), &[1e-2, 0.1, 1.0]);
    }

    /// If there is no room for two numbers, they move closer, down to the height of a letter.
    #[test]
    fn one_number_alone_gives_no_scale() {
        assert_eq!(ticks(&Axis::linear("x", 0.1, 0.9), 10.0, 34.0).2, ["0.5"]);
        assert_eq!(ticks(&Axis::linear("x", 0.0, 10.0), 100.0, 60.0).2, ["0", "10"]);
        assert_eq!(ticks(&Axis::linear("x", 0.5, 3.2), 100.0, 60.0).2, ["1", "2", "3"]);
    }

    #[test]
    fn decades_have_nine_small_steps_or_every_other_one_a_number() {
        let axis = Axis::logarithmic("x", 2e-3, 30.0);
        let (places, small, numbers) = ticks(&axis, 100.0, 10.0);
        assert_near(&places, &[1e-2, 0.1, 1.0, 10.0]);
        assert_eq!(numbers, ["10^{\u{2212}2}", "10^{\u{2212}1}", "10^{0}", "10^{1}"]);
        let mut expected: Vec<f64> = (2..10).map(|m| f64::from(m) * 1e-3).collect();
        expected.extend([1e-2, 0.1, 1.0].iter().flat_map(|decade| (1..10).map(move |m| f64::from(m) * decade)));
        expected.extend([10.0, 20.0, 30.0]);
        assert_near(&small, &expected);
        // 4.2 decades with at least one number per 0.3 of the length: every second one; per 0.2: every one; for exactly one decade: its ends.
        let (places, small, _) = ticks(&axis, 100.0, 30.0);
        assert_near(&places, &[1e-2, 1.0]);
        assert_near(&small, &[1e-2, 0.1, 1.0, 10.0]);
        assert_near(&ticks(&axis, 100.0, 20.0).0, &[1e-2, 0.1, 1.0, 10.0]);
        assert_near(&ticks(&Axis::logarithmic("x", 1.0, 10.0), 100.0, 100.0).0, &[1.0, 10.0]);
        assert_near(&ticks(&Axis::logarithmic("x", 10.0, 1e3), 100.0, 40.0).0, &[10.0, 100.0, 1e3]);
    }

    #[test]
    fn a_value_has_its_part_of_the_axis() {
        assert_near(&[-1.0, 0.0, 1.0, 3.0].map(|x| Axis::linear("x", -1.0, 3.0).place(x)), &[0.0, 0.25, 0.5, 1.0]);
        assert_near(&[0.1, 1.0, 100.0].map(|x| Axis::logarithmic("x", 0.1, 100.0).place(x)), &[0.0, 1.0 / 3.0, 1.0]);
    }

    /// Six hundredths of the range on either side; for a constant within rounding a twentieth of the value.
    #[test]
    fn an_axis_has_room_around_its_values() {
        let ends = |values: &[f64]| {
            let axis = Axis::around("x", values.iter().copied());
            [axis.low, axis.high]
        };
        assert_near(&ends(&[3.0, -1.0, 2.0]), &[-1.24, 3.24]);
        assert_near(&ends(&[-4.0, -4.0]), &[-4.2, -3.8]);
        assert_near(&ends(&[1.0, 1.0009]), &[1.0 - 0.05 * 1.0009, 1.0009 * 1.05]);
        assert_near(&ends(&[1.0, 1.0011]), &[1.0 - 6.6e-5, 1.0011 + 6.6e-5]);
        assert_near(&ends(&[0.0, 0.0]), &[-1.0, 1.0]);
        assert_near(&ends(&[0.25, 0.25]), &[0.2375, 0.2625]);
        // Less than a thousandth of the size is not a range.
        assert_near(&ends(&[4000.0, 4003.0]), &[4000.0 - 200.15, 4203.15]);
        assert_near(&ends(&[-4003.0, -4000.0]), &[-4203.15, -4000.0 + 200.15]);
    }

    #[test]
    fn a_zero_has_no_sign() {
        assert_eq!(
            ["-0.0", "-0", "-0.5", "-10", "2", "-0.05"].map(signed),
            ["0.0", "0", "\u{2212}0.5", "\u{2212}10", "2", "\u{2212}0.05"]
        );
    }

    /// A single number gives no scale: the distance is then halved. On many decades there is one small tick per decade.
    #[test]
    fn there_are_two_numbers_and_not_too_many_ticks() {
        let (places, ..) = ticks(&Axis::linear("x", 0.0, 1.5), 100.0, 70.0);
        assert_near(&places, &[0.0, 1.0]);
        let (places, small, _) = ticks(&Axis::logarithmic("x", 1e-10, 1.0), 60.0, 20.0);
        assert_near(&places, &[1e-8, 1e-4, 1.0]);
        assert_near(&small, &(-10..=0).map(|n| 10f64.powi(n)).collect::<Vec<_>>());
    }
}
