//! Joints, force sensors, dummies.

use super::Colour;
use crate::ttt::stream::streams;
use crate::ttt::value::{EngineBlock, Text};

streams! {
    /// A joint.
    Joint until b"EOO" {
        /// 10 revolute, 11 prismatic, 12 spherical.
        joint_type: Option<i32> = b"Jtt",
        /// Screw lead / 2pi.
        screw_pitch: Option<f64> = b"_sp" / b"Jsp",
        screw_lead: Option<f64> = b"Sld",
        /// Sqw, sqx, sqy, sqz; spherical joint orientation.
        spherical: Option<[f64; 4]> = b"_st" / b"Jst",
        /// Bit0 cyclic, bit4 motor on, bit5 ctrl on, bit6 hybrid, bit7 spring mode.
        switches: Option<u8> = b"Va9",
        /// Bit1 lock motor at zero velocity, bit2 enforce limits.
        switches_2: Option<u8> = b"Vaa",
        colour: Option<Colour> = b"Cl1",
        /// Second colour (until 4.2).
        second_colour: Option<Colour> = b"Cl2",
        /// Pos min, pos range.
        limits: Option<[f64; 2]> = b"_mr" / b"Pmr",
        position: Option<f64> = b"_rt" / b"Prt",
        ik_max_step: Option<f64> = b"_ss" / b"Mss",
        /// Length, diameter.
        sizes: Option<[f64; 2]> = b"_rg" / b"Arg",
        ik_weight: Option<f64> = b"_kw" / b"Ikw",
        /// 0 kinematic, 2 ik (old), 3 reserved->4, 4 dependent, 5 dynamic.
        joint_mode: Option<i32> = b"Jmd",
        /// Dep handle, dep mult, dep offset.
        dependency: Option<(i32, [f64; 2])> = b"_dt" / b"Jdt",
        /// Max accel old, vel old.
        old_motion: Option<[f64; 2]> = b"_m3" / b"Jm3",
        /// Max accel old, vel old, target vel.
        older_motion: Option<[f32; 3]> = b"Jm2",
        /// Target vel, target force.
        motor: Option<[f64; 2]> = b"_mp" / b"Dmp",
        /// P, i, d; before 3.1.1: I and D are divided by 0.005 on load.
        oldest_pid: Option<[f32; 3]> = b"Dpc",
        /// P, i, d; until 4.4.
        old_pid: Option<[f32; 3]> = b"Dp2",
        /// Spring k, spring c.
        spring: Option<[f64; 2]> = b"_pp" / b"Spp",
        target_pos: Option<f64> = b"_tp" / b"Dtp",
        /// Read only.
        old_ode: Option<[f32; 5]> = b"Od1",
        /// Read only.
        old_bullet: Option<[f32; 3]> = b"Bt1",
        bullet: Option<EngineBlock> = b"_tN" / b"BtN",
        ode: Option<EngineBlock> = b"_dN" / b"OdN",
        vortex: Option<EngineBlock> = b"_o2" / b"Vo2",
        newton: Option<EngineBlock> = b"_w1" / b"Nw1",
        mujoco: Option<EngineBlock> = b"_j3" / b"Mj3",
        /// Read only.
        callback_order: Option<i32> = b"Cco",
        /// Max vel, max accel, max jerk.
        max_vel_accel_jerk: Option<[f64; 3]> = b"_uc" / b"Ruc",
        /// Until 4.3.
        upper_velocity_limit: Option<f32> = b"Ulv",
        /// 0 free,1 force,4 velocity,8 position,12 spring,16 callback.
        dyn_ctrl_mode: Option<i32> = b"Dcm",
        pos_ctrl_profile: Option<i32> = b"Dpm",
        vel_ctrl_profile: Option<i32> = b"Dvm",
        /// Bit0 smooth motion profile (development version after 4.10).
        switches_3: Option<u8> = b"V10",
    }

    /// A force sensor.
    ForceSensor until b"EOO" {
        size: Option<f64> = b"_iz" / b"Siz",
        /// Bit0 force threshold on, bit1 torque threshold on.
        switches: Option<u8> = b"Vab",
        /// Force threshold, torque threshold, violations.
        thresholds: Option<([f64; 2], i32)> = b"_ri" / b"Tri",
        /// Force threshold, torque threshold, violations; as Tri and breaks automatically.
        old_thresholds: Option<([f32; 2], i32)> = b"Tre",
        /// Filter samples, filter type; 0 average,1 median.
        filter: Option<[i32; 2]> = b"Fil",
        colour: Option<Colour> = b"Cl1",
        /// Read only.
        second_colour: Option<Colour> = b"Cl2",
    }

    /// A dummy.
    Dummy until b"EOO" {
        size: Option<f64> = b"_y2" / b"Dy2",
        assembly_tag: Option<Text> = b"Atg",
        colour: Option<Colour> = b"Cl0",
        linked_dummy: Option<i32> = b"Lli",
        /// Bit1 on parent path, bit2 free on trajectory, bit3 path orientation.
        switches: Option<u8> = b"Var",
        /// Path off, path off copy.
        path_offsets: Option<[f64; 2]> = b"_o5" / b"Po5",
        /// Read only.
        path_off: Option<f32> = b"Po4",
        /// 0 dyn loop closure,... see text.
        link_type: Option<i32> = b"Dl2",
        /// Read only.
        old_acknowledgment: Option<Text> = b"Ack",
        mujoco: Option<EngineBlock> = b"_j1" / b"Mj1",
    }
}
