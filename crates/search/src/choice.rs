//! A number that a test asks for.

use std::cmp::Ordering;

/// Decimals up to which numbers count as short.
const DECIMALS: i32 = 6;
/// Halvings of the way to the simplest number that are tried.
const STEPS: i32 = 24;

/// The numbers a choice may have. `simplest` is one of them, the one that shrinking approaches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Domain {
    /// Whole numbers from `min` to `max`.
    Integer {
        /// The least.
        min: i64,
        /// The greatest.
        max: i64,
        /// What shrinking approaches.
        simplest: i64,
    },
    /// Numbers from `min` to `max`.
    Float {
        /// The least.
        min: f64,
        /// The greatest.
        max: f64,
        /// What shrinking approaches.
        simplest: f64,
    },
    /// Whether a list has one more element, 1 or 0; simplest where it ends.
    Follows {
        /// How often it has, at random.
        probability: f64,
    },
}

/// The value of a choice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// A whole number.
    Integer(i64),
    /// A number.
    Float(f64),
}

/// A choice that was made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choice {
    /// What it could have been.
    pub domain: Domain,
    /// What it is.
    pub value: Value,
}

impl Domain {
    /// Whole numbers from `min` to `max`, simplest where they are nearest to zero.
    pub fn integers(min: i64, max: i64) -> Self {
        let simplest = 0.clamp(min, max.max(min));
        Self::Integer { min, max, simplest }
    }

    /// Numbers from `min` to `max`, simplest where they are nearest to zero.
    pub fn floats(min: f64, max: f64) -> Self {
        let simplest = 0.0_f64.max(min).min(max);
        Self::Float { min, max, simplest }
    }

    /// The simplest value.
    pub fn simplest(self) -> Value {
        match self {
            Self::Integer { simplest, .. } => Value::Integer(simplest),
            Self::Follows { .. } => Value::Integer(0),
            Self::Float { simplest, .. } => Value::Float(simplest),
        }
    }

    /// The least value.
    pub fn min(self) -> Value {
        match self {
            Self::Integer { min, .. } => Value::Integer(min),
            Self::Follows { .. } => Value::Integer(0),
            Self::Float { min, .. } => Value::Float(min),
        }
    }

    /// The greatest value.
    pub fn max(self) -> Value {
        match self {
            Self::Integer { max, .. } => Value::Integer(max),
            Self::Follows { .. } => Value::Integer(1),
            Self::Float { max, .. } => Value::Float(max),
        }
    }

    /// The value of this domain that is nearest to `value`; the simplest one for what is no number.
    pub fn nearest(self, value: Value) -> Value {
        match self {
            Self::Integer { min, max, .. } => Value::Integer(value.rounded().clamp(min, max)),
            Self::Follows { .. } => Value::Integer(value.rounded().clamp(0, 1)),
            Self::Float { min, max, simplest } => {
                let value = value.as_float();
                Value::Float(if value.is_nan() {
                    simplest
                } else {
                    value.clamp(min, max)
                })
            }
        }
    }

    /// The value at `share` of the way from the least to the greatest.
    pub(crate) fn at(self, share: f64) -> Value {
        match self {
            Self::Integer { min, max, .. } => {
                // In 128 bits, since the bounds may be all there are.
                let count = (i128::from(max) - i128::from(min) + 1) as f64;
                let offset = ((share * count) as i128).min(i128::from(max) - i128::from(min));
                Value::Integer((i128::from(min) + offset) as i64)
            }
            Self::Follows { probability } => Value::Integer(i64::from(share < probability)),
            Self::Float { min, max, .. } => {
                // Halves do not overflow.
                let value = min * (1.0 - share) + max * share;
                self.nearest(Value::Float(value))
            }
        }
    }

    /// How far apart the least and the greatest are.
    pub(crate) fn width(self) -> f64 {
        self.max().as_float() - self.min().as_float()
    }
}

impl Value {
    /// The number.
    pub fn as_float(self) -> f64 {
        match self {
            Self::Integer(value) => value as f64,
            Self::Float(value) => value,
        }
    }

    /// The nearest whole number there is; zero for what is no number.
    fn rounded(self) -> i64 {
        match self {
            Self::Integer(value) => value,
            // Saturates.
            Self::Float(value) => libm::round(value) as i64,
        }
    }
}

impl Choice {
    /// Whether it is a value that is not simplest, rather than the length of a list.
    pub fn is_chosen(&self) -> bool {
        !matches!(self.domain, Domain::Follows { .. }) && !self.is_simplest()
    }

    /// Whether it cannot be simpler.
    pub fn is_simplest(&self) -> bool {
        self.value == self.domain.simplest()
    }

    /// Orders values of equal meaning by simplicity: the simplest one, short numbers before long ones, then by the distance from the simplest.
    pub(crate) fn compare(&self, other: &Self) -> Ordering {
        let key = |choice: &Self| {
            let distance = choice.value.as_float() - choice.domain.simplest().as_float();
            (choice.decimals(), libm::fabs(distance))
        };
        let (a, b) = (key(self), key(other));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    }

    /// How many decimals the value has; -1 for the simplest one.
    fn decimals(&self) -> i32 {
        if self.is_simplest() {
            return -1;
        }
        let Value::Float(value) = self.value else {
            return 0;
        };
        let is_short = |decimals: &i32| rounded(value, *decimals) == value;
        (0..=DECIMALS).find(is_short).unwrap_or(DECIMALS + 1)
    }

    /// Values that may be simpler, the boldest first.
    pub(crate) fn simpler(&self) -> Vec<Value> {
        let simplest = self.domain.simplest();
        let mut values = vec![simplest];
        match (self.value, simplest) {
            (Value::Integer(value), Value::Integer(simplest)) => {
                let distance = i128::from(value) - i128::from(simplest);
                let steps = (1..64).map(|k| distance / (1_i128 << k));
                let steps = steps.take_while(|step| *step != 0);
                values.extend(steps.map(|step| Value::Integer((i128::from(value) - step) as i64)));
            }
            (Value::Float(value), simplest) => {
                values.extend((0..=DECIMALS).map(|d| Value::Float(rounded(value, d))));
                let decimals = self.decimals().max(1);
                let distance = value - simplest.as_float();
                let unit = 10_f64.powi(-decimals) / 2.0;
                let steps = (1..STEPS).map(|k| distance / f64::from(1 << k));
                let steps = steps.take_while(|step| libm::fabs(*step) > unit);
                values.extend(
                    steps
                        .clone()
                        .map(|step| Value::Float(rounded(value - step, 0))),
                );
                values.extend(steps.map(|step| Value::Float(rounded(value - step, decimals))));
            }
            _ => {}
        }
        let better = |value: &Value| {
            let simpler = Self {
                value: self.domain.nearest(*value),
                ..*self
            };
            (simpler.compare(self) == Ordering::Less).then_some(simpler.value)
        };
        let mut values: Vec<_> = values.iter().filter_map(better).collect();
        let mut known = Vec::new();
        values.retain(|value| {
            !known.contains(value) && {
                known.push(*value);
                true
            }
        });
        values
    }
}

/// The number with so many decimals that is nearest to `value`.
fn rounded(value: f64, decimals: i32) -> f64 {
    let scale = 10_f64.powi(decimals);
    let rounded = libm::round(value * scale) / scale;
    if rounded.is_finite() { rounded } else { value }
}
