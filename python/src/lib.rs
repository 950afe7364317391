//! The Python module `twofold`: scenes, motions, pulsars, fits, sweeps and kernels, on arrays of numpy.

mod arguments;
mod arrays;
mod error;
mod fit;
mod interrupt;
mod kernels;
mod motion;
mod pickle;
mod pulsar;
mod scene;
mod sweep;
mod table;
mod timing_model;
mod writing;

/// Python aligns memory to 16 bytes only: types with vector registers, which need more, are boxed.
const _: () = {
    assert!(
        align_of::<scene::Scene>() <= 16 && align_of::<motion::Motion>() <= 16 && align_of::<pulsar::Pulsar>() <= 16
    );
    assert!(align_of::<pulsar::Timing>() <= 16 && align_of::<timing_model::TimingModel>() <= 16);
    assert!(align_of::<fit::Fit>() <= 16 && align_of::<fit::TimingData>() <= 16 && align_of::<table::Table>() <= 16);
    assert!(align_of::<sweep::Sweep>() <= 16 && align_of::<sweep::SweepFile>() <= 16);
};

/// The compiled part of the package.
#[pyo3::pymodule(name = "_twofold")]
mod module {
    use numpy::PyArray1;
    use pyo3::prelude::*;

    /// Imports numpy's array functions at import: later a pending Ctrl-C could make this fail.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        PyArray1::<f64>::zeros(module.py(), 0, false);
        Ok(())
    }

    /// Version of the package.
    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_export]
    use crate::error::Error;
    #[pymodule_export]
    use crate::fit::{Fit, TimingData, fit_timing, wobble_limits, wobble_posterior};
    #[pymodule_export]
    use crate::kernels::kernels;
    #[pymodule_export]
    use crate::motion::Motion;
    #[pymodule_export]
    use crate::pulsar::{Pulsar, Timing};
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::sweep::{Sweep, SweepFile};
    #[pymodule_export]
    use crate::table::Table;
    #[pymodule_export]
    use crate::timing_model::TimingModel;
}
