//! Options of a table, by their names.

use crate::{ApiError, Result};
use scene::Data;

/// Refuses options that mean nothing.
pub(super) fn check_names(options: &Data, names: &[&str]) -> Result<()> {
    let Data::Map(entries) = options else {
        return Ok(());
    };
    for (key, _) in entries {
        let scene::Key::Text(name) = key else {
            return Err(ApiError::Other("options have names.".into()));
        };
        let name = String::from_utf8_lossy(name);
        if !names.contains(&&*name) {
            let known = names.join(", ");
            return Err(ApiError::Other(format!(
                "there is no option '{name}', but: {known}."
            )));
        }
    }
    Ok(())
}

pub(super) fn wrong(name: &str) -> ApiError {
    ApiError::Other(format!("invalid value of option '{name}'."))
}

pub(super) fn given<'a>(options: &'a Data, name: &str) -> Option<&'a Data> {
    options.field(name).filter(|value| **value != Data::Nil)
}

pub(super) fn number(options: &Data, name: &str, default: f64) -> Result<f64> {
    let Some(value) = given(options, name) else {
        return Ok(default);
    };
    let value = value.as_f64().filter(|x| x.is_finite() && *x >= 0.0);
    value.ok_or_else(|| wrong(name))
}

pub(super) fn positive(options: &Data, name: &str, default: f64) -> Result<f64> {
    let value = number(options, name, default)?;
    if value > 0.0 {
        Ok(value)
    } else {
        Err(wrong(name))
    }
}

pub(super) fn truth(options: &Data, name: &str, default: bool) -> Result<bool> {
    match given(options, name) {
        None => Ok(default),
        Some(Data::Bool(value)) => Ok(*value),
        Some(_) => Err(wrong(name)),
    }
}

/// Numbers of a list.
pub(super) fn list(options: &Data, name: &str) -> Result<Option<Vec<f64>>> {
    let Some(value) = given(options, name) else {
        return Ok(None);
    };
    let Data::Array(entries) = value else {
        return Err(wrong(name));
    };
    let numbers: Option<Vec<f64>> = entries.iter().map(Data::as_f64).collect();
    Ok(Some(numbers.ok_or_else(|| wrong(name))?))
}

pub(super) fn numbers<const N: usize>(options: &Data, name: &str) -> Result<Option<[f64; N]>> {
    let Some(list) = list(options, name)? else {
        return Ok(None);
    };
    let numbers: Option<[f64; N]> = list.try_into().ok();
    Ok(Some(numbers.ok_or_else(|| wrong(name))?))
}

/// Three coordinates each.
pub(super) fn triples(options: &Data, name: &str) -> Result<Option<Vec<[f64; 3]>>> {
    let Some(list) = list(options, name)? else {
        return Ok(None);
    };
    let (triples, rest) = list.as_chunks::<3>();
    if rest.is_empty() {
        Ok(Some(triples.to_vec()))
    } else {
        Err(wrong(name))
    }
}

/// Whole numbers, from 0.
pub(super) fn indices<const N: usize>(options: &Data, name: &str) -> Result<Option<Vec<[u32; N]>>> {
    let Some(list) = list(options, name)? else {
        return Ok(None);
    };
    let index = |number: &f64| {
        let is_index = number.fract() == 0.0 && (0.0..f64::from(u32::MAX)).contains(number);
        is_index.then_some(*number as u32)
    };
    let indices: Option<Vec<u32>> = list.iter().map(index).collect();
    let indices = indices.ok_or_else(|| wrong(name))?;
    let (groups, rest) = indices.as_chunks::<N>();
    if rest.is_empty() {
        Ok(Some(groups.to_vec()))
    } else {
        Err(wrong(name))
    }
}

/// Whole numbers of cells along so many axes.
pub(super) fn counts<const N: usize>(options: &Data, name: &str) -> Result<Option<[usize; N]>> {
    let Some(numbers) = numbers::<N>(options, name)? else {
        return Ok(None);
    };
    let is_count = |number: &f64| number.fract() == 0.0 && (1.0..=1000.0).contains(number);
    if numbers.iter().all(is_count) {
        Ok(Some(numbers.map(|number| number as usize)))
    } else {
        Err(wrong(name))
    }
}
