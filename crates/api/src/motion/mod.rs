//! `sim.*`: joints, trajectories, forces.

pub(crate) mod dynamics;
pub(crate) mod joint;
pub(crate) mod joint_motion;
pub(crate) mod ruckig;
pub(crate) mod trajectory;
