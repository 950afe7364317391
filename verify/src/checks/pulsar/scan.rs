//! The pulse train compared with a scan of `m.n`. Eq. (44).

use super::cases::{Case, edges, worst_over_random_cases};
use crate::prelude::*;

checks! {
    /// for both beams of 10,000 random stars over 10 t_c there are as many edges as a scan of m.n finds with a point each 0.01 t_c and each
    /// extremum between them refined, and inside and outside agree
    Oracle "pulse-train-scan" [44, 47]: against_scan;
    AtMost(0.0) "trains with a wrong number of edges, or inside where the scan is outside, of 20,000 random ones";
    because "a count: the scan misses no pair of edges, since it evaluates every extremum and skips only intervals in which m cannot reach the edge";
}

fn against_scan() -> Result<Measured, String> {
    let (mut wrong, mut total, mut trains, mut looks, mut first) = (0, 0, 0, 0, String::new());
    // Search and scan use the same numerical motion, so that its error does not matter.
    worst_over_random_cases(44, 10_000, (END, 1e-10), |case| {
        let train = case.train()?;
        let mut scan = Scan::of(case);
        scan.search(0, POINTS);
        let inside = |t: f64| train.pulses.iter().any(|p| p.start <= t && t <= p.end);
        let differ = scan.points.iter().any(|&(t, margin)| margin.abs() > 1e-12 && inside(t) != (margin > 0.0));
        trains += 1;
        total += scan.edges;
        looks += scan.points.len();
        if edges(&train).len() != scan.edges || differ || !train.grazings.is_empty() {
            wrong += 1;
            if first.is_empty() {
                first = format!("; first {}, {} edges by the scan, {}", case.name, scan.edges, edges(&train).len());
            }
        }
        Ok(0.0)
    })?;
    if total < 50_000 {
        return Err(format!("only {total} edges were met"));
    }
    Ok(Measured::new(f64::from(wrong), format!("{trains} trains with {total} edges, {looks} looks at m.n{first}")))
}

const END: f64 = 10.0;

/// Intervals of the full scan.
const POINTS: u32 = 1024;

/// A scan of one case. Only values of `m.n` and signs of its rate are used.
struct Scan<'a> {
    case: &'a Case,
    /// More than the largest rotation rate.
    turning: f64,
    edges: usize,
    /// Evaluated times, with the margin.
    points: Vec<(f64, f64)>,
}

impl<'a> Scan<'a> {
    fn of(case: &'a Case) -> Self {
        let turning = |i: i32| {
            let state = case.motion.state(END * f64::from(i) / 20.0).expect("a time of the span");
            angular_velocity(case.motion.spheroid(), &state.axis, &state.momentum).norm()
        };
        // 1.5 times the largest of 21 rates. The oracle does not use a bound of the search that it tests.
        let turning = 1.5 * (0..=20).map(turning).fold(0.0, f64::max);
        Self { case, turning, edges: 0, points: Vec::new() }
    }

    fn time(index: u32) -> f64 {
        END * f64::from(index) / f64::from(POINTS)
    }

    /// Scans between two points by bisection. An interval is skipped if m is too far from the edge of the beam to reach it in
    /// time.
    fn search(&mut self, from: u32, to: u32) {
        let middle = (from + to) / 2;
        if to - from > 1 {
            let state = self.case.motion.state(Self::time(middle)).expect("a time of the span");
            let margin = self.case.beam.margin(&state, &self.case.observer);
            self.points.push((Self::time(middle), margin));
            if margin.abs() < self.turning * (Self::time(to) - Self::time(middle)) {
                self.search(from, middle);
                self.search(middle, to);
            }
        } else {
            self.count(Self::time(from), Self::time(to));
        }
    }

    /// Counts the edges between neighbours: one if the sides differ, two if an extremum between them is on the other side.
    fn count(&mut self, mut low: f64, mut high: f64) {
        let ([first, rate, ..], [second, next_rate, ..]) = (self.case.margin(low), self.case.margin(high));
        if (first > 0.0) != (second > 0.0) {
            self.edges += 1;
        } else if (rate > 0.0) != (next_rate > 0.0) {
            while high - low > 1e-9 {
                let middle = (low + high) / 2.0;
                if (self.case.margin(middle)[1] > 0.0) == (rate > 0.0) { low = middle } else { high = middle }
            }
            if (self.case.margin((low + high) / 2.0)[0] > 0.0) != (first > 0.0) {
                self.edges += 2;
            }
        }
    }
}
