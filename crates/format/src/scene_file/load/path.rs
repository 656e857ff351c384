//! Paths of V-REP.

use super::sensors::colour;
use crate::ttt::chunks::{Path, PathControl, PathPoint};
use scene::Pose;
use scene::appearance::colour::Colour;
use scene::path_object::{
    ControlPoint, LengthMethod, PathAttributes, PathMeasures, PathObject, Shaping, VelocityProfile,
};

/// The bit of [`Path::flags`]; the others concern the shape along the path.
const EXPLICIT: u8 = 0x20;
const SHAPING: u8 = 0xf;

pub(super) fn path(chunk: &Path) -> PathObject {
    let default = PathControl::default();
    let line = chunk.path.as_ref().unwrap_or(&default);
    let attributes = line
        .attributes
        .map_or(PathAttributes::DEFAULT, PathAttributes::from_bits_retain);
    let mut path = PathObject::new(attributes, measures(line));
    let points = line.points.iter().filter_map(control_point).collect();
    // A path with too many points stays empty.
    let _ = path.insert(0, points, attributes.contains(PathAttributes::CLOSED));
    if let Some([position, max_acceleration, nominal, target]) =
        line.motion.filter(|m| m.iter().all(|n| n.is_finite()))
    {
        path.set_motion(position, max_acceleration, nominal, target);
    }
    (path.line_size, path.point_size) = line.line.unwrap_or((path.line_size, path.point_size));
    let flags = chunk.flags.unwrap_or(0);
    path.explicit = flags & EXPLICIT != 0;
    path.shaping = Some(shaping(chunk, flags & SHAPING));
    path
}

fn measures(line: &PathControl) -> PathMeasures {
    let default = PathMeasures::default();
    let finite = |value: f64, other: f64| if value.is_finite() { value } else { other };
    let (angle, method) = line
        .length
        .unwrap_or((default.angle_coefficient, default.length_method as i32));
    let profile = line
        .averages
        .filter(|numbers| numbers.iter().all(|n| n.is_finite()))
        .map_or(default.profile, |[radius, axis_change, acceleration]| {
            VelocityProfile {
                radius,
                axis_change,
                acceleration,
            }
        });
    PathMeasures {
        length_method: LengthMethod::from_number(method.into()).unwrap_or(default.length_method),
        angle_coefficient: finite(angle, default.angle_coefficient),
        on_spot_coefficient: finite(
            line.on_spot_coeff.unwrap_or(default.on_spot_coefficient),
            default.on_spot_coefficient,
        ),
        profile,
    }
}

fn control_point(point: &PathPoint) -> Option<ControlPoint> {
    let (place, [before, after], count, velocity) = point.point.as_ref()?;
    let (flags, channels) = point.auxiliary.unwrap_or((0, [0.0; 4]));
    let pose: Pose = place.pose()?;
    let on_spot = point.on_spot.unwrap_or(0.0);
    let count = usize::try_from((*count).max(1)).ok()?;
    let (before, after, velocity) = (*before, *after, *velocity);
    Some(
        ControlPoint {
            pose,
            before,
            after,
            count,
            velocity,
            on_spot,
            flags,
            channels,
        }
        .limited(),
    )
}

fn shaping(chunk: &Path, flags: u8) -> Shaping {
    let white = Colour::new([1.0; 3]);
    Shaping {
        flags,
        scale: chunk.shaping_scale.unwrap_or(1.0),
        element: chunk.element.unwrap_or((0.05, 0)),
        section: chunk
            .section
            .as_ref()
            .map(|section| section.0.clone())
            .unwrap_or_default(),
        colour: chunk
            .colour
            .as_ref()
            .map_or(white, |chunk| colour(chunk, white, false)),
    }
}
