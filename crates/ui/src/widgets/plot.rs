//! Plots: curves of points, axes, labels.

use std::collections::BTreeMap;

use super::super::error::{UiError, UiResult};

/// What the points of a curve are sorted by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveType {
    /// By x.
    Time,
    /// By a parameter of their own, so that a curve may return.
    Xy,
}

impl CurveType {
    /// The kind with that number (simUI.curve_type).
    pub fn from_code(code: i64) -> Option<Self> {
        match code {
            20400 => Some(Self::Time),
            20401 => Some(Self::Xy),
            _ => None,
        }
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Xy => "xy",
        }
    }
}

/// How a curve is drawn; numbers are those of simUI's constants.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveOptions {
    /// Shape of the points.
    pub scatter_shape: i64,
    /// Size of the points, pixels.
    pub scatter_size: i64,
    /// Width of the line, pixels.
    pub line_size: i64,
    /// Style of the line: solid, dashed and so on.
    pub line_style: i64,
    /// Listed in the legend.
    pub add_to_legend: bool,
    /// A person can select it.
    pub selectable: bool,
    /// The axes move along with the newest point.
    pub track: bool,
}

impl Default for CurveOptions {
    fn default() -> Self {
        Self {
            scatter_shape: 28405,
            scatter_size: 10,
            line_size: 2,
            line_style: 32000,
            add_to_legend: true,
            selectable: true,
            track: false,
        }
    }
}

/// A curve of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Name, unique in the plot.
    pub name: String,
    /// What its points are sorted by.
    pub curve_type: CurveType,
    /// Red, green, blue, 0 to 255.
    pub color: [i64; 3],
    /// How points are linked (simUI.curve_style).
    pub style: i64,
    /// How it is drawn.
    pub options: CurveOptions,
    /// What it is sorted by, x, y of each point, in order.
    pub points: Vec<[f64; 3]>,
}

impl Curve {
    /// Adds points: a point with an equal key comes after those that are there. At most `limit` points are kept, unless it is not positive:
    /// the newest ones of a cyclic buffer, else the first ones.
    fn add(&mut self, points: impl Iterator<Item = [f64; 3]>, limit: i64, cyclic: bool) {
        let limit = usize::try_from(limit).ok().filter(|limit| *limit > 0);
        if limit.is_some_and(|limit| !cyclic && self.points.len() >= limit) {
            return;
        }
        // Keys mostly arrive in order, so that sorting what is sorted is cheap.
        self.points.extend(points);
        self.points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let Some(limit) = limit.filter(|limit| self.points.len() > *limit) else {
            return;
        };
        if cyclic {
            let oldest = self.points[self.points.len() - limit][0];
            self.points
                .retain(|point| point[0].total_cmp(&oldest).is_ge());
        } else {
            let last = self.points[limit - 1][0];
            self.points
                .retain(|point| point[0].total_cmp(&last).is_le());
        }
    }

    /// The smallest and the largest value of a coordinate, 1 for x and 2 for y; None without finite ones.
    fn range(&self, coordinate: usize) -> Option<[f64; 2]> {
        let values = self
            .points
            .iter()
            .map(|point| point[coordinate])
            .filter(|value| value.is_finite());
        values.fold(None, |range: Option<[f64; 2]>, value| {
            let [low, high] = range.unwrap_or([value; 2]);
            Some([low.min(value), high.max(value)])
        })
    }
}

/// A plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Colours that differ from the default, by attribute: red, green, blue, 0 to 255.
    pub colors: BTreeMap<&'static str, [i64; 3]>,
    /// Both axes have the same scale.
    pub square: bool,
    /// Points of a curve; not positive for any number.
    pub(crate) max_buffer_size: i64,
    pub(crate) cyclic_buffer: bool,
    /// Whether the axes of x and y have ticks.
    pub(crate) ticks: [bool; 2],
    pub(crate) tick_labels: [bool; 2],
    /// The curves in the order of their creation.
    pub curves: Vec<Curve>,
    /// Smallest and largest x, then y.
    pub ranges: [[f64; 2]; 2],
    /// The labels of the axes of x and y.
    pub labels: [String; 2],
    /// Whether the legend is shown.
    pub legend_visible: bool,
    /// What the mouse does: moves x, moves y, scales x, scales y.
    pub mouse: [bool; 4],
    /// How often it was drawn again.
    pub replots: u64,
}

impl Default for Plot {
    fn default() -> Self {
        Self {
            colors: BTreeMap::new(),
            square: false,
            max_buffer_size: 1000,
            cyclic_buffer: false,
            ticks: [true; 2],
            tick_labels: [true; 2],
            curves: Vec::new(),
            ranges: [[0.0, 5.0]; 2],
            labels: [String::new(), String::new()],
            legend_visible: false,
            mouse: [false; 4],
            replots: 0,
        }
    }
}

impl Plot {
    /// The curve with that name.
    ///
    /// # Errors
    /// When there is no curve of that name.
    pub fn curve(&self, name: &str) -> UiResult<&Curve> {
        self.curves
            .iter()
            .find(|curve| curve.name == name)
            .ok_or_else(|| no_curve(name))
    }

    fn curve_mut(&mut self, name: &str) -> UiResult<&mut Curve> {
        self.curves
            .iter_mut()
            .find(|curve| curve.name == name)
            .ok_or_else(|| no_curve(name))
    }

    /// Adds a curve.
    ///
    /// # Errors
    /// When there is a curve of that name.
    pub fn add_curve(&mut self, curve: Curve) -> UiResult<()> {
        if self.curve(&curve.name).is_ok() {
            return Err(UiError::other(format!(
                "curve with name \"{}\" already exists",
                curve.name
            )));
        }
        self.curves.push(curve);
        Ok(())
    }

    /// Adds points to a curve: the key they are sorted by, x, y. A full buffer drops the oldest or refuses the newest.
    ///
    /// # Errors
    /// When there is no curve of that name and type.
    pub fn add_points(
        &mut self,
        name: &str,
        curve_type: CurveType,
        points: impl Iterator<Item = [f64; 3]>,
    ) -> UiResult<()> {
        let (limit, cyclic) = (self.max_buffer_size, self.cyclic_buffer);
        let curve = self.curve_mut(name)?;
        if curve.curve_type != curve_type {
            return Err(UiError::other(format!(
                "curve must be of type '{}'",
                curve_type.name()
            )));
        }
        curve.add(points, limit, cyclic);
        Ok(())
    }

    /// Removes the points of a curve.
    ///
    /// # Errors
    /// When there is no curve of that name.
    pub fn clear_curve(&mut self, name: &str) -> UiResult<()> {
        self.curve_mut(name)?.points.clear();
        Ok(())
    }

    /// Removes a curve.
    ///
    /// # Errors
    /// When there is no curve of that name.
    pub fn remove_curve(&mut self, name: &str) -> UiResult<()> {
        self.curve(name)?;
        self.curves.retain(|curve| curve.name != name);
        Ok(())
    }

    /// Moves the lower end of an axis, 0 for x and 1 for y, down by `lower` and the upper one up by `upper`.
    pub fn grow(&mut self, axis: usize, [lower, upper]: [f64; 2]) {
        self.ranges[axis][0] -= lower;
        self.ranges[axis][1] += upper;
    }

    /// Fits the axes to a curve, or to all; one that may only grow does not lose what it shows.
    ///
    /// # Errors
    /// When there is no curve of that name.
    pub fn rescale(&mut self, name: Option<&str>, only_enlarge: [bool; 2]) -> UiResult<()> {
        let curves: Vec<&Curve> = match name {
            Some(name) => vec![self.curve(name)?],
            None => self.curves.iter().collect(),
        };
        let mut ranges = self.ranges;
        for (axis, range) in ranges.iter_mut().enumerate() {
            let found = curves.iter().filter_map(|curve| curve.range(axis + 1));
            let kept = only_enlarge[axis].then_some(*range);
            let united = kept
                .into_iter()
                .chain(found)
                .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
            *range = united.unwrap_or(*range);
        }
        self.ranges = ranges;
        Ok(())
    }
}

fn no_curve(name: &str) -> UiError {
    UiError::other(format!("curve with name \"{name}\" does not exist"))
}
