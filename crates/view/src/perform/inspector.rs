//! Rows of the inspector: properties with values, groups and units.

use serde_json::{Value, json};

use super::values::to_json;
use simulator::PropertyRow;
use simulator::Simulator;

/// Units of properties that have one: name, unit.
const UNITS: &str = include_str!("units.tsv");

/// Names of the properties of an object, and their rows.
///
/// # Errors
/// When there is nothing with that handle.
pub(crate) fn rows(sim: &Simulator, handle: i64) -> Result<Vec<(String, Value)>, String> {
    let rows = sim
        .property_rows(handle)
        .map_err(|error| error.to_string())?;
    Ok(rows
        .into_iter()
        .map(|row| (row.name.clone(), describe(&row)))
        .collect())
}

fn describe(row: &PropertyRow) -> Value {
    json!({
        "name": row.name,
        "type": row.ty.word(),
        "value": to_json(&row.value),
        "writable": row.is_writable,
        "group": group(row),
        "unit": unit(&row.name),
        "label": label(&row.name),
    })
}

/// The headings of the reference: pose and place, appearance, physics, and the type's own.
fn group(row: &PropertyRow) -> &'static str {
    let name = row.name.as_str();
    let begins = |words: &[&str]| words.iter().any(|word| name.starts_with(word));
    // Classes are paths, such as `app.scene.object.joint`.
    match row.class.rsplit('.').next().unwrap_or_default() {
        "data" => "data",
        "object" if begins(&["pose", "bb", "mov", "calc"]) => "pose",
        "object" if begins(&["model"]) => "model",
        _ if begins(&["color", "applyColor", "rayColor", "lightColor"]) => "color",
        _ if begins(&[
            "bullet",
            "ode",
            "vortex",
            "newton",
            "mujoco",
            "rapier",
            "engineProperties",
        ]) =>
        {
            "engine"
        }
        _ if begins(&[
            "dyn",
            "respondable",
            "mass",
            "inertia",
            "centerOfMass",
            "init",
            "principal",
            "kinematic",
        ]) =>
        {
            "dynamics"
        }
        class => class,
    }
}

fn unit(name: &str) -> Option<&'static str> {
    UNITS.lines().find_map(|line| {
        line.split_once('\t')
            .filter(|(known, _)| *known == name)
            .map(|(_, unit)| unit)
    })
}

/// The name in words: `jointPosition` is a joint position.
fn label(name: &str) -> String {
    let mut words = String::with_capacity(name.len() + 8);
    for letter in name.chars() {
        match letter {
            '.' | '_' => words.push(' '),
            letter
                if letter.is_ascii_uppercase()
                    && words.ends_with(|last: char| last.is_ascii_lowercase()) =>
            {
                words.push(' ');
                words.push(letter.to_ascii_lowercase());
            }
            letter => words.push(letter),
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_words() {
        assert_eq!(label("jointPosition"), "joint position");
        assert_eq!(label("color.diffuse"), "color diffuse");
        assert_eq!(label("bbHSize"), "bb h size");
        assert_eq!((unit("mass"), unit("alias")), (Some("kg"), None));
    }
}
