//! A pulsar over decades: arrival times, its timing model, its wave.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use twofold::dynamics::{AxisState, RotationState};
use twofold::epoch::Epoch;
use twofold::observables::wave_harmonics::WaveHarmonics;
use twofold_scene::pulsar_timing::{self, PulsarScene, csv, par, tim};

use crate::arguments::{by_arguments, number};
use crate::arrays::Numbers;
use crate::error::raised;
use crate::pickle::Reduced;
use crate::scene::Scene;
use crate::table::Table;
use crate::timing_model::TimingModel;

/// The pulsar of a scene, computed by its phases, whose error grows only by the rounding of the rates: arrival times drift by at most 1.1e-15 of the time since the epoch (docs/pulsars.md). Times `t` are in seconds since the epoch of the scene (TDB at the barycentre).
#[pyclass(frozen, module = "twofold")]
pub struct Pulsar {
    pub(crate) scene: Py<Scene>,
    pub(crate) pulsar: PulsarScene,
}

/// The epoch of a modified Julian date.
pub fn epoch(date: f64) -> PyResult<Epoch> {
    twofold::Error::ensure((0.0..=1e7).contains(&date), "epoch (MJD)", date, "from 0 to 1e7").map_err(raised)?;
    Epoch::new(date.floor() as i64, date - date.floor()).map_err(raised)
}

#[pymethods]
impl Pulsar {
    /// The pulses nearest to `epochs` (MJD), or to the times of the scene, and a fit of F0 and the given number of `derivatives` to them: two for a scene with `[spin_down]`, which needs four
    /// different epochs or more, and none for others. With `causes` the table has the causes of the residuals.
    #[pyo3(signature = (epochs=None, *, derivatives=None, causes=false))]
    fn arrivals(
        &self,
        py: Python<'_>,
        epochs: Option<Numbers>,
        derivatives: Option<usize>,
        causes: bool,
    ) -> PyResult<Timing> {
        let scene = self.scene.get().scene.clone();
        let epochs = match epochs {
            Some(dates) => dates.list("epochs")?.into_iter().map(epoch).collect::<PyResult<Vec<_>>>()?,
            None => {
                let since_start = scene.times.iter().map(|t| [t - scene.times.start(), 0.0]);
                since_start.map(|t| self.pulsar.epoch.after(t)).collect::<Result<_, _>>().map_err(raised)?
            }
        };
        if epochs.is_empty() {
            return Err(raised("epochs: must contain at least one epoch"));
        }
        let derivatives = derivatives.unwrap_or(if scene.spin_down.is_some() { 2 } else { 0 });
        let found = py.detach(|| {
            let timing = self.pulsar.timed(&epochs, derivatives).map_err(|error| error.to_string())?;
            let causes = causes.then(|| self.pulsar.causes(&timing)).transpose()?;
            let table = Table::of_csv(csv(&self.pulsar, &timing, causes.as_ref()).into_bytes())?;
            let par = par(&scene, &timing).map_err(|error| error.to_string())?;
            Ok::<_, String>((table, par, timing))
        });
        let (table, par, timing) = found.map_err(by_arguments)?;
        Ok(Timing { table: Py::new(py, table)?, par, timing })
    }

    /// The phase of the pulses in closed form, with derivatives by its parameters: for a star without Lorentz violation or with the motion of `L` that follows from it as a rate of the inclination.
    fn timing_model(&self) -> PyResult<TimingModel> {
        Ok(TimingModel { model: self.pulsar.clock.timing_model().map_err(raised)? })
    }

    /// The scene of the pulsar.
    #[getter]
    fn scene(&self, py: Python<'_>) -> Py<Scene> {
        self.scene.clone_ref(py)
    }

    /// Modified Julian date of the start (TDB), as a text.
    #[getter]
    fn epoch(&self) -> String {
        self.pulsar.epoch.to_string()
    }

    /// Mean period of the pulses (s) at the epoch.
    #[getter]
    fn period(&self) -> f64 {
        self.pulsar.clock.period()
    }

    /// Rates (rad/s) of the precession of the body about its axis and of its angular momentum. The first is that of `e_x` about `n` relative to the plane of `n` and `L`, positive in the right-handed sense; `precession_rate` of
    /// `timing_model()` is minus this, since its angle goes from the magnetic axis, which the body carries, to `L`; for a star of negative spin the timing model is that of `-n`, and its rate equals this. The second is positive where the angular momentum goes in the right-handed sense round the principal axis of `s^IJ` that it circles, directed so that its largest component is positive.
    #[getter]
    fn precession_rates(&self) -> PyResult<[f64; 2]> {
        self.pulsar.clock.precession_rates().map_err(raised)
    }

    /// Strain `h_+` and `h_x` at times: two arrays. The scene needs `observer.distance`.
    fn wave<'py>(&self, py: Python<'py>, t: Numbers) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        if self.pulsar.strain_unit.is_none() {
            return Err(raised("the scene lacks `observer.distance` [kpc], without which there is no strain"));
        }
        let found = t.map(py, |_, t| {
            let wave = self.pulsar.wave(&self.state(t)?);
            Ok::<_, twofold::Error>(wave.map_or([f64::NAN; 2], |wave| [wave.plus, wave.cross]))
        })?;
        let [plus, cross] = [0, 1].map(|part| t.shaped(py, found.iter().map(|wave| wave[part]).collect(), &[]));
        Ok((plus?, cross?))
    }

    /// The two harmonics of the wave at times, those of a star without a torque with the `L` and the wobble of each time: amplitudes `h_1` (once a turn) and `h_2` (twice), the phase `Phi` of the symmetry axis about `L` from the line of sight, from -pi to pi, and the inclination, position angle
    /// and wobble (rad): six arrays. With them `h_+' = -h_1 sin(2i)/2 cos(Phi) + h_2 (1 + cos^2 i)/2 cos(2 Phi)` and `h_x' = -h_1 sin i sin(Phi) + h_2 cos i sin(2 Phi)` along the projection of `L` on the sky. They are the whole `wave` without Lorentz violation. With it, they differ from it by about the ratio
    /// of the torque to the rotation, `C s / (I_xx Omega^2)`: for the scene `wave-source` at 20 Hz by `0.03 s` of the largest strain, at 200 Hz by `3e-4 s`.
    fn wave_harmonics<'py>(&self, py: Python<'py>, t: Numbers) -> PyResult<Bound<'py, PyTuple>> {
        let unit = self.pulsar.strain_unit.unwrap_or(f64::NAN);
        let spheroid = self.pulsar.problem.spheroid();
        let found = t.map(py, |_, t| {
            let h = WaveHarmonics::of(spheroid, &self.state(t)?, &self.pulsar.observer)?;
            Ok::<_, twofold::Error>([h.once * unit, h.twice * unit, h.phase, h.inclination, h.orientation, h.wobble])
        })?;
        let part = |part: usize| t.shaped(py, found.iter().map(|values| values[part]).collect(), &[]);
        PyTuple::new(py, (0..6).map(part).collect::<PyResult<Vec<_>>>()?)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<Pulsar of {}, period {:?} s>", self.scene.bind(py).repr()?, self.period()))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        Ok((self.scene.bind(py).getattr("pulsar")?, PyTuple::empty(py)))
    }
}

impl Pulsar {
    fn state(&self, t: f64) -> Result<AxisState<f64>, twofold::Error> {
        twofold::Error::ensure(t.is_finite(), "t (s)", t, "a finite number")?;
        Ok(self.pulsar.clock.near([t, 0.0])(0.0)?.axis_state())
    }
}

/// Arrival times and their residuals from a fitted frequency.
#[pyclass(frozen, module = "twofold")]
pub struct Timing {
    /// Number, arrival time, residual, width, position angle and wave of each pulse.
    #[pyo3(get)]
    table: Py<Table>,
    /// The `.par` of the fit.
    #[pyo3(get)]
    par: String,
    timing: pulsar_timing::Timing,
}

#[pymethods]
impl Timing {
    /// The `.tim` (FORMAT 1, barycentre), with an uncertainty (s) for all.
    #[pyo3(signature = (uncertainty: "SupportsFloat | SupportsIndex"=1e-6))]
    fn tim(&self, #[pyo3(from_py_with = number)] uncertainty: f64) -> PyResult<String> {
        twofold::Error::ensure(
            uncertainty > 0.0 && uncertainty.is_finite(),
            "uncertainty (s)",
            uncertainty,
            "above zero",
        )
        .map_err(raised)?;
        Ok(tim(&self.timing, uncertainty))
    }

    /// F0 (Hz) at `epoch`, the sum of two doubles.
    #[getter]
    fn frequency(&self) -> [f64; 2] {
        self.timing.fit.frequency
    }

    /// F1 (Hz/s) and F2 (Hz/s^2), as many as were fitted.
    #[getter]
    fn derivatives(&self) -> Vec<f64> {
        self.timing.fit.derivatives.into_iter().take(self.timing.derivatives).collect()
    }

    /// PEPOCH (MJD), as a text.
    #[getter]
    fn epoch(&self) -> String {
        self.timing.epoch.to_string()
    }

    /// Epochs without a pulse.
    #[getter]
    fn dark(&self) -> usize {
        self.timing.dark
    }

    fn __repr__(&self) -> String {
        let (count, size) = (self.timing.pulses.len(), self.timing.root_mean_square());
        format!("<Timing: {count} pulses, residuals of {size:.3e} s (root mean square)>")
    }
}
