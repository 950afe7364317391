//! One column out of all groups, by its name.

use twofold::plan::Output;

use super::{ALL, ColumnGroup, Moment};
use crate::scene_file::{Scene, listed, nearest};

/// Angles that grow without end or jump by a turn: a spectrum would be that of the growth or of the jumps.
const TURNING: [&str; 5] = ["alpha", "gamma", "alpha_printed", "Phi", "psi"];

/// One column of a table.
#[derive(Debug)]
pub struct Column {
    group: &'static ColumnGroup,
    index: usize,
    /// It and the columns of its group with the same unit: parts of one whole, as the components of a vector, with one rounding.
    parts: Vec<usize>,
    /// Name as in the header of the table, without the unit.
    pub name: String,
    /// Unit.
    pub unit: String,
}

impl Column {
    /// The column called `name`, if it oscillates and the scene has what it needs.
    ///
    /// # Errors
    /// A sentence that says which columns there are, or why this one is none of them.
    pub fn oscillating(name: &str, scene: &Scene) -> Result<Self, String> {
        let columns: Vec<_> = ALL.into_iter().flat_map(|group| Self::of_group(group, scene)).collect();
        if TURNING.contains(&name) {
            return Err(format!(
                "`{name}` turns without end and has no spectrum; take its rate, a component of an axis or m.n"
            ));
        }
        if let Some(found) = columns.iter().position(|column| column.name == name) {
            let column = columns.into_iter().nth(found).expect("its position is known");
            return column.group.available_in(scene).map(|()| column);
        }
        let possible = columns
            .iter()
            .filter(|column| column.group.available_in(scene).is_ok() && !TURNING.contains(&column.name.as_str()));
        let possible: Vec<_> = possible.map(|column| column.name.as_str()).collect();
        let guess = nearest(name, &possible).map(|near| format!(" Did you mean `{near}`?")).unwrap_or_default();
        Err(format!("`{name}` is no column; this scene has {}.{guess}", listed(&possible)))
    }

    /// What a plan takes it for. Its angles need not count turns.
    pub fn output(&self) -> Output {
        self.group.output
    }

    fn of_group(group: &'static ColumnGroup, scene: &Scene) -> impl Iterator<Item = Self> {
        let titles = (group.header)(&scene.units);
        let of = |title: &str| {
            let (name, unit) = title.split_once(" [").unwrap_or((title, ""));
            (name.to_owned(), unit.trim_end_matches(']').to_owned())
        };
        let columns: Vec<_> = titles.iter().map(|title| of(title)).collect();
        (0..columns.len()).map(move |index| {
            let (name, unit) = columns[index].clone();
            let is_part = |&other: &usize| {
                let (name, its_unit) = &columns[other];
                other == index || *its_unit == unit && !TURNING.contains(&name.as_str())
            };
            Self { group, index, parts: (0..columns.len()).filter(is_part).collect(), name, unit }
        })
    }

    /// The value at a time of the motion and the size of what it is a part of, as `|L|` for a component of `L`, in the unit of the output;
    /// none where they do not exist.
    pub fn value_and_size(&self, scene: &Scene, moment: &mut Moment<'_>) -> Option<(f64, f64)> {
        let values = (self.group.values)(scene, moment)?;
        let size = self.parts.iter().fold(0.0_f64, |size, &part| size.hypot(values[part]));
        Some((values[self.index], size))
    }
}
