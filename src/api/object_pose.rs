//! `sim.*`: where objects are.

use api_macro::api;

use super::{ApiFn, Cx, Result, functions};
use crate::scene::{Frame, Pose, flag, special};
use crate::script::ObjectRef;

pub(crate) const FUNCTIONS: &[ApiFn] = functions![get_object_position];

/// Position of an object.
///
/// @param objectHandle the object
/// @param relativeToObjectHandle the frame to express it in
/// @return position metres
#[api("sim.getObjectPosition")]
fn get_object_position(
    cx: &Cx,
    object_handle: ObjectRef,
    #[default(special::WORLD)] relative_to_object_handle: RelativeTo,
) -> Result<[f64; 3]> {
    let joint_base = object_handle.has(flag::REL_JOINT_BASE_FRAME);
    let pose = cx.scene().pose_in(object_handle.handle, relative_to_object_handle.0, joint_base)?;
    Ok(position_of(&pose))
}

fn position_of(pose: &Pose) -> [f64; 3] {
    pose.translation.vector.into()
}

/// A frame, as the position functions read it: a float is the world, and the inverse is not known to them.
struct RelativeTo(Frame);

impl From<i64> for RelativeTo {
    fn from(_: i64) -> Self {
        Self(Frame::World)
    }
}

impl crate::script::FromScript for RelativeTo {
    const TYPE: &'static str = "int";

    fn from_script(args: &crate::script::Args<'_>) -> Result<Self> {
        let frame = i64::from_script(args).map_or(Ok(Frame::World), Frame::from_raw)?;
        if frame == Frame::Inverse {
            return Err(crate::scene::SceneError::NoSuchObject.into());
        }
        Ok(Self(frame))
    }
}
