//! Units of the figures of a motion: those of the paper, or seconds, hertz and strain for a physical star.

use std::f64::consts::TAU;

use super::axes::Axis;
use twofold_scene::scene_file::{Scene, Units};

/// The values of one `t_c` and of `h = 1` in a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    pub(super) units: Units,
    /// Strain of `h = 1` at the observer; in the paper's units one.
    strain: f64,
}

impl Scale {
    pub const PAPER: Self = Self { units: Units::PAPER, strain: 1.0 };

    pub(super) fn of_scene(scene: &Scene) -> Self {
        Self { units: scene.units, strain: scene.strain_unit() }
    }

    /// A time (t_c) in the unit of the figure.
    pub(super) fn time(&self, t: f64) -> f64 {
        t * self.units.time
    }

    /// An angular frequency (rad/t_c) in the unit of the figure: rad/t_c, or a frequency in Hz.
    pub(super) fn frequency(&self, omega: f64) -> f64 {
        if self.units.are_physical() { omega / (TAU * self.units.time) } else { omega }
    }

    /// A wave `h` in the paper's units at `r = 1`, in the unit of the figure.
    pub(super) fn wave(&self, h: f64) -> f64 {
        h * self.strain
    }

    pub(super) fn time_unit(&self) -> &'static str {
        if self.units.are_physical() { "s" } else { "*t*_{c}" }
    }

    /// Label for an axis of times.
    pub(super) fn time_label(&self, what: &str) -> String {
        if self.units.are_physical() { format!("{what} [s]") } else { format!("{what} / *t*_{{c}}") }
    }

    /// The axis of time from the start to a time (t_c), forwards or backwards.
    pub(super) fn time_axis(&self, end: f64) -> Axis {
        let end = self.time(end);
        Axis::linear(&self.time_label("*t*"), end.min(0.0), end.max(0.0))
    }

    /// Header of a column of times.
    pub(super) fn time_column(&self, what: &str) -> String {
        format!("{what} [{}]", self.units.time_name)
    }

    pub(super) fn frequency_label(&self) -> &'static str {
        if self.units.are_physical() { "frequency [Hz]" } else { "angular frequency × *t*_{c}" }
    }

    pub(super) fn frequency_unit(&self) -> &'static str {
        if self.units.are_physical() { "Hz" } else { "rad/*t*_{c}" }
    }

    pub(super) fn frequency_column(&self) -> String {
        format!("frequency [{}]", if self.units.are_physical() { "Hz" } else { "rad/t_c" })
    }

    pub(super) fn wave_label(&self, symbol: &str) -> String {
        if self.units.are_physical() { symbol.to_owned() } else { format!("{symbol} *r* / *I*^{{*xx*}}") }
    }

    pub(super) fn wave_unit(&self) -> &'static str {
        if self.units.are_physical() { "as strain" } else { "in units of *G* *I*^{*xx*} / (*c*^{4} *t*_{c}^{2} *r*)" }
    }

    pub(super) fn wave_column_unit(&self) -> &'static str {
        if self.units.are_physical() { "1" } else { "G I^xx / (c^4 t_c^2 r)" }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::axes::Panel;
    use crate::figures::svg::Rectangle;

    #[test]
    fn an_axis_of_time_goes_from_the_start_either_way() {
        let frame = Rectangle { left: 0.0, top: 0.0, width: 1.0, height: 1.0 };
        for (end, places) in [(8.0, [0.0, 0.25, 1.0]), (-8.0, [1.0, 0.75, 0.0])] {
            let panel = Panel::new(frame, Scale::PAPER.time_axis(end), Axis::linear("", 0.0, 1.0));
            assert_eq!([0.0, 0.25 * end, end].map(|t| panel.at(t, 0.0)[0]), places);
        }
    }
}
