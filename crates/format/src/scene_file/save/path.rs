//! Paths of V-REP.

use super::colour;
use crate::ttt::Counted;
use crate::ttt::chunks::{Colour, Path, PathControl, PathPoint};
use scene::path_object::{ControlPoint, PathObject};

/// Set where a path is handled explicitly.
const EXPLICIT: u8 = 0x20;

pub(super) fn path(path: &PathObject, line_colour: Option<Colour>) -> Path {
    let shaping = path.shaping.as_ref();
    let explicit = if path.explicit { EXPLICIT } else { 0 };
    Path {
        flags: Some(shaping.map_or(0, |shaping| shaping.flags) | explicit),
        shaping_scale: shaping.map(|shaping| shaping.scale),
        element: shaping.map(|shaping| shaping.element),
        path: Some(line(path, line_colour)),
        section: shaping.map(|shaping| Counted(shaping.section.clone())),
        colour: shaping.map(|shaping| colour::colour(&shaping.colour)),
    }
}

fn line(path: &PathObject, colour: Option<Colour>) -> PathControl {
    let measures = path.measures();
    let profile = measures.profile;
    PathControl {
        points: path.control_points().iter().map(point).collect(),
        line: Some((path.line_size, path.point_size)),
        attributes: Some(path.attributes().bits()),
        colour,
        motion: Some([
            path.position(),
            path.max_acceleration,
            path.nominal_velocity,
            path.target_velocity,
        ]),
        length: Some((measures.angle_coefficient, measures.length_method as i32)),
        on_spot_coeff: Some(measures.on_spot_coefficient),
        averages: Some([profile.radius, profile.axis_change, profile.acceleration]),
    }
}

fn point(point: &ControlPoint) -> PathPoint {
    let rounding = [point.before, point.after];
    PathPoint {
        point: Some((
            point.pose.into(),
            rounding,
            numbers::count_i32(point.count),
            point.velocity,
        )),
        on_spot: Some(point.on_spot),
        auxiliary: Some((point.flags, point.channels)),
    }
}
