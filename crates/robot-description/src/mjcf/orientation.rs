//! Poses as MJCF writes them.

use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

use super::attributes::Attributes;
use super::document::Settings;
use super::element::Report;
use crate::model::Pose;
use crate::positions::turn;

/// The attributes that say an orientation: one of them.
const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

/// `pos` and an orientation of an element.
pub fn pose(attributes: &Attributes, settings: &Settings, report: &mut Report) -> Pose {
    let position = attributes.numbers(report, "pos", [0.0; 3]);
    Pose::from_parts(
        Vector3::from(position).into(),
        rotation(attributes, settings, report),
    )
}

fn rotation(
    attributes: &Attributes,
    settings: &Settings,
    report: &mut Report,
) -> UnitQuaternion<f64> {
    let Some((name, text)) = attributes.first_of(&ORIENTATIONS) else {
        return UnitQuaternion::identity();
    };
    let numbers = report.numbers(attributes.element, name, text);
    let expected = match name {
        "quat" | "axisangle" => 4,
        "xyaxes" => 6,
        _ => 3,
    };
    if numbers.len() != expected {
        report.warn(
            attributes.element,
            format!("{name} has {} numbers instead of {expected}", numbers.len()),
        );
        return UnitQuaternion::identity();
    }
    of_numbers(name, &numbers, settings).unwrap_or_else(|| {
        report.warn(
            attributes.element,
            format!("{name} is no orientation; it is left out"),
        );
        UnitQuaternion::identity()
    })
}

fn of_numbers(name: &str, numbers: &[f64], settings: &Settings) -> Option<UnitQuaternion<f64>> {
    match (name, numbers) {
        ("quat", [w, x, y, z]) => UnitQuaternion::try_new(Quaternion::new(*w, *x, *y, *z), 1e-12),
        ("axisangle", [x, y, z, angle]) => {
            let axis = Unit::try_new(Vector3::new(*x, *y, *z), 1e-12)?;
            Some(turn(&axis, settings.angle(*angle)))
        }
        ("xyaxes", [x0, x1, x2, y0, y1, y2]) => {
            of_axes([*x0, *x1, *x2].into(), [*y0, *y1, *y2].into())
        }
        ("zaxis", [x, y, z]) => along(Vector3::new(*x, *y, *z)),
        ("euler", [a, b, c]) => Some(of_euler(
            [*a, *b, *c].map(|angle| settings.angle(angle)),
            settings.sequence,
        )),
        _ => None,
    }
}

/// The smallest rotation that takes z to a direction.
pub fn along(direction: Vector3<f64>) -> Option<UnitQuaternion<f64>> {
    let direction = Unit::try_new(direction, 1e-12)?;
    let half_turn = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    Some(UnitQuaternion::rotation_between(&Vector3::z(), &direction).unwrap_or_else(half_turn))
}

fn of_axes(x: Vector3<f64>, y: Vector3<f64>) -> Option<UnitQuaternion<f64>> {
    let x = x.try_normalize(1e-12)?;
    let y = (y - x * x.dot(&y)).try_normalize(1e-12)?;
    let axes = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
    Some(UnitQuaternion::from_rotation_matrix(&axes))
}

/// Turns about axes: of the turned frame where their letters are small, of the fixed one where they are capital.
fn of_euler(angles: [f64; 3], sequence: [u8; 3]) -> UnitQuaternion<f64> {
    let mut rotation = UnitQuaternion::identity();
    for (angle, letter) in angles.into_iter().zip(sequence) {
        let axis = match letter.to_ascii_lowercase() {
            b'x' => Vector3::x_axis(),
            b'y' => Vector3::y_axis(),
            _ => Vector3::z_axis(),
        };
        let turned = turn(&axis, angle);
        rotation = if letter.is_ascii_lowercase() {
            rotation * turned
        } else {
            turned * rotation
        };
    }
    rotation
}
