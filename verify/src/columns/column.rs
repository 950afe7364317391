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
        (group.header)(&scene.units).into_iter().enumerate().map(move |(index, title)| {
            let (name, unit) = title.split_once(" [").unwrap_or((&title, ""));
            Self { group, index, name: name.to_owned(), unit: unit.trim_end_matches(']').to_owned() }
        })
    }

    /// The value at a time of the motion, in the unit of the output; none where it does not exist.
    pub fn value(&self, scene: &Scene, moment: &mut Moment<'_>) -> Option<f64> {
        (self.group.values)(scene, moment).map(|values| values[self.index])
    }
}
