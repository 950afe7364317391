//! The angles of a torus with their whole turns.

use super::TorusSolution;
use crate::numerics::double_double::DoubleDouble;
use crate::solutions::averaged::Turns;

impl TorusSolution {
    /// Turns of the three angles at the time `t[0] + t[1]` since the start, including whole turns. The fractions are the arguments
    /// of [`state_on_torus`](Self::state_on_torus), accurate to some 1e-16.
    pub(crate) fn angles(&self, t: [f64; 2]) -> [Turns; 3] {
        let time = DoubleDouble::sum(t[0], t[1]);
        self.phases.map(|phase| Turns::at(phase.offset.high, phase.rate, time))
    }
}
