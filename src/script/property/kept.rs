//! Properties that are only kept: their defaults, and what may be written to them.

use super::{Sim, Target};
use crate::scene::{Data, ValueType};
use crate::script::error::{ApiError, ApiResult};

/// The value of type `ty` that stands in the table as `text`; None when it does not say one.
pub(super) fn parse_default(ty: ValueType, text: &str) -> Option<Data> {
    let numbers = |empty: &[f64]| -> Option<Data> {
        let given: Vec<f64> = text.split_whitespace().map(|word| word.parse().ok()).collect::<Option<_>>()?;
        let complete = given.len() == empty.len() || empty.is_empty();
        if text.is_empty() { Some(empty.to_vec().into()) } else { complete.then(|| given.into()) }
    };
    let integers = |empty: &[i64]| -> Option<Data> {
        let given: Vec<i64> = text.split_whitespace().map(|word| word.parse().ok()).collect::<Option<_>>()?;
        Some(if text.is_empty() { empty.to_vec().into() } else { given.into() })
    };
    match ty {
        ValueType::Bool => matches!(text, "" | "true" | "false").then_some(Data::Bool(text == "true")),
        ValueType::Int | ValueType::Long if text.is_empty() => Some(Data::Int(0)),
        ValueType::Int | ValueType::Long => text.parse().ok().map(Data::Int),
        ValueType::Float if text.is_empty() => Some(Data::Float(0.0)),
        ValueType::Float => text.parse().ok().map(Data::Float),
        ValueType::String => Some(Data::text(text)),
        ValueType::Buffer => text.is_empty().then(|| Data::Buffer(Vec::new())),
        ValueType::Table => text.is_empty().then(|| Data::Array(Vec::new())),
        ValueType::FloatArray => numbers(&[]),
        ValueType::Vector2 => numbers(&[0.0; 2]),
        ValueType::Vector3 | ValueType::Color => numbers(&[0.0; 3]),
        ValueType::Quaternion => numbers(&[0.0, 0.0, 0.0, 1.0]),
        ValueType::Pose => numbers(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        ValueType::IntArray => integers(&[]),
        ValueType::IntArray2 => integers(&[0; 2]),
    }
}

/// The value as it is kept in place of `default`: finite, and a list as long as the default.
pub(super) fn checked(default: &Data, mut value: Data) -> ApiResult<Data> {
    if let (Data::Array(default), Data::Array(items)) = (default, &mut value) {
        if items.len() < default.len() {
            return Err(ApiError::PropertyNotWritable);
        }
        if !default.is_empty() {
            items.truncate(default.len());
        }
    }
    if is_finite(&value) { Ok(value) } else { Err(ApiError::PropertyNotWritable) }
}

fn is_finite(value: &Data) -> bool {
    match value {
        Data::Float(number) => number.is_finite(),
        Data::Array(items) => items.iter().all(is_finite),
        _ => true,
    }
}

impl Sim {
    /// A kept value; None while nobody set it.
    pub(super) fn read_kept(&self, target: &Target, name: &str) -> ApiResult<Option<Data>> {
        match target {
            Target::App => Ok(self.app.borrow().kept.get(name).cloned()),
            Target::Scene => Ok(self.scene.borrow().kept(None, name)?.cloned()),
            Target::Object(handle) => Ok(self.scene.borrow().kept(Some(*handle), name)?.cloned()),
            Target::Script(_) => Ok(None),
        }
    }

    /// Keeps a value.
    pub(super) fn write_kept(&self, target: &Target, name: &'static str, value: Data) -> ApiResult<()> {
        match target {
            Target::App => {
                self.app.borrow_mut().kept.set(name, value);
            }
            Target::Scene => self.scene.borrow_mut().keep(None, name, value)?,
            Target::Object(handle) => self.scene.borrow_mut().keep(Some(*handle), name, value)?,
            Target::Script(_) => return Err(ApiError::PropertyNotWritable),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Data, ValueType, checked, parse_default};

    #[test]
    fn defaults_are_read_from_the_table() {
        assert_eq!(parse_default(ValueType::FloatArray, "0.02 1"), Some(vec![0.02, 1.0].into()));
        assert_eq!(parse_default(ValueType::Color, ""), Some([0.0; 3].into()));
        assert_eq!(parse_default(ValueType::Color, "1"), None);
        assert_eq!(parse_default(ValueType::Int, "x"), None);
    }

    #[test]
    fn lists_keep_the_length_of_their_default() {
        let default: Data = vec![0.0; 2].into();
        assert_eq!(checked(&default, vec![1.0, 2.0, 3.0].into()), Ok(vec![1.0, 2.0].into()));
        assert!(checked(&default, vec![1.0].into()).is_err());
        assert!(checked(&default, vec![1.0, f64::NAN].into()).is_err());
        assert_eq!(checked(&Data::Array(vec![]), vec![1.0].into()), Ok(vec![1.0].into()));
    }
}
