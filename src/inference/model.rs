//! What can be fitted: a model with named numbers.

use core::fmt::Debug;

use super::Symmetry;
use super::symmetry::symmetries;
use crate::error::Error;
use crate::observables::pulsar::timing_model::{TimingModel, TimingParameter};
use crate::parameters::{Parameter, Parameters};

/// The name of a number of a [`Model`].
pub trait Unknown: Copy + PartialEq + Debug {
    /// In commands and files.
    fn key(self) -> &'static str;

    /// In symbols.
    fn symbol(self) -> &'static str;

    /// Interval that a fit stays within, where there is one.
    fn limits(self) -> (Option<f64>, Option<f64>);
}

/// A model with numbers of which some are unknown.
pub trait Model: Clone {
    /// What they are called.
    type Unknown: Unknown;

    /// The value of one.
    fn value(&self, unknown: Self::Unknown) -> f64;

    /// By how much one is more than in another model.
    fn difference(&self, other: &Self, unknown: Self::Unknown) -> f64 {
        self.value(unknown) - other.value(unknown)
    }

    /// The model with some of them changed.
    ///
    /// # Errors
    /// Numbers that no such model has.
    fn moved(&self, unknowns: &[Self::Unknown], changes: &[f64]) -> Result<Self, Error>;

    /// How far a value can be from a known one at all: a radian, the rate of rotation, one.
    fn range(&self, unknown: Self::Unknown) -> f64;

    /// Changes that nobody can see.
    fn symmetries(&self) -> Vec<Symmetry<Self::Unknown>>;
}

impl Unknown for Parameter {
    fn key(self) -> &'static str {
        Self::key(self)
    }

    fn symbol(self) -> &'static str {
        Self::symbol(self)
    }

    fn limits(self) -> (Option<f64>, Option<f64>) {
        Self::limits(self)
    }
}

impl Model for Parameters<f64> {
    type Unknown = Parameter;

    fn value(&self, unknown: Parameter) -> f64 {
        unknown.value(self)
    }

    fn moved(&self, unknowns: &[Parameter], changes: &[f64]) -> Result<Self, Error> {
        Ok(Self::moved(self, unknowns, changes))
    }

    fn range(&self, unknown: Parameter) -> f64 {
        unknown.range(self)
    }

    fn symmetries(&self) -> Vec<Symmetry<Parameter>> {
        symmetries(self)
    }
}

impl Unknown for TimingParameter {
    fn key(self) -> &'static str {
        Self::key(self)
    }

    fn symbol(self) -> &'static str {
        Self::key(self)
    }

    fn limits(self) -> (Option<f64>, Option<f64>) {
        Self::limits(self)
    }
}

impl Model for TimingModel {
    type Unknown = TimingParameter;

    fn value(&self, unknown: TimingParameter) -> f64 {
        Self::value(self, unknown)
    }

    fn difference(&self, other: &Self, unknown: TimingParameter) -> f64 {
        if unknown == TimingParameter::F0 {
            let ([a, b], [c, d]) = (self.frequency(), other.frequency());
            return (a - c) + (b - d);
        }
        self.value(unknown) - other.value(unknown)
    }

    fn moved(&self, unknowns: &[TimingParameter], changes: &[f64]) -> Result<Self, Error> {
        let changes: Vec<_> = unknowns.iter().copied().zip(changes.iter().copied()).collect();
        Self::moved(self, &changes)
    }

    fn range(&self, unknown: TimingParameter) -> f64 {
        use TimingParameter::{F0, F1, F2, InclinationRate, PrecessionRate};
        match unknown {
            F0 | F1 | F2 | PrecessionRate | InclinationRate => self.value(F0),
            _ => 1.0,
        }
    }

    fn symmetries(&self) -> Vec<Symmetry<TimingParameter>> {
        Vec::new()
    }
}
