//! `sim.*`: joints, trajectories, forces.

pub(in crate::api) mod dynamics;
pub(in crate::api) mod joint;
pub(in crate::api) mod joint_motion;
pub(in crate::api) mod ruckig;
pub(in crate::api) mod trajectory;
