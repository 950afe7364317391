//! Common imports of the figures.

pub(super) use super::axes::*;
pub(super) use super::caption::*;
pub(super) use super::legend::*;
pub(super) use super::number::*;
pub(super) use super::parameters::*;
pub(super) use super::recipe::Sheet;
pub(super) use super::sphere::*;
pub(super) use super::style::*;
pub(super) use super::subject::*;
pub(super) use super::svg::*;
pub(super) use super::table::*;
