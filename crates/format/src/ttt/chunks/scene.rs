//! Scene-level and model-level chunks.

use super::Colour;
use crate::ttt::stream::streams;
use crate::ttt::value::{Counted, EngineBlock, PositionFirst, Rest, Text};

streams! {
    /// How a simulation runs.
    Simulation until b"EOO" {
        old_dt: Option<f32> = b"Sts",
        /// Microseconds.
        dt_us: Option<u64> = b"St2",
        dt: Option<f64> = b"_t3" / b"St3",
        passes_per_frame: Option<i32> = b"Spr",
        /// 0..4 = 200,100,50,25,10 ms; 5 custom.
        old_preset: Option<i32> = b"Spi",
        /// Bit0 real time, bit2 pause at time, bit3 pause at script error, bit5 full screen, bit6 (old) no reset at end, bit7 keep new objects at end.
        switches: Option<u8> = b"Ss2",
        /// Read only.
        old_switches: Option<u8> = b"Sst",
        old_rt_coef: Option<f32> = b"Rtc",
        rt_coef: Option<f64> = b"Rt2",
        old_pause: Option<f32> = b"Pat",
        pause_us: Option<u64> = b"Pa2",
        pause_time: Option<f64> = b"_a3" / b"Pa3",
    }

    /// How the physics runs.
    Dynamics until b"EOO" {
        /// Engine, gx, gy, gz, mode.
        engine: Option<(i32, [f64; 3], i32)> = b"_n3" / b"En3",
        /// Engine, gx, gy, gz, mode m1; read only.
        old_engine: Option<(i32, [f32; 3], i32)> = b"En2",
        /// Engine, gx, gy, gz, mode m1; read only.
        oldest_engine: Option<(i32, [f32; 3], i32)> = b"Eng",
        engine_version: Option<i32> = b"Ver",
        step_size: Option<f64> = b"_tp" / b"Stp",
        /// Step, scale, iterations, margin; read only.
        old_bullet: Option<([f32; 2], i32, f32)> = b"Bul",
        /// Step, scale, iterations, cfm, erp; read only.
        old_ode: Option<([f32; 2], i32, [f32; 2])> = b"Ode",
        vortex: Option<EngineBlock> = b"_o5" / b"Vo5",
        newton: Option<EngineBlock> = b"_w1" / b"Nw1",
        mujoco: Option<EngineBlock> = b"_j1" / b"Mj1",
        /// Bit0 dynamics enabled, bit1 show contacts, bit2 Bullet full scaling, bit3 ODE full scaling, bit4 ODE quickstep.
        switches: Option<u8> = b"Var",
        bullet: Option<EngineBlock> = b"_uN" / b"BuN",
        ode: Option<EngineBlock> = b"_dN" / b"OdN",
    }

    /// Environment and remarks.
    Environment until b"EOO" {
        fog_end: Option<f64> = b"_dn" / b"Fdn",
        active_layers: Option<u16> = b"Vil",
        /// Fog type, fog start, fog density.
        fog: Option<(i32, [f64; 2])> = b"_d2" / b"Fd2",
        bg_up: Option<[f32; 3]> = b"Clc",
        bg_down: Option<[f32; 3]> = b"Cld",
        fog_colour: Option<[f32; 3]> = b"Fbg",
        old_ambient: Option<[f32; 3]> = b"Alc",
        ambient: Option<[f32; 3]> = b"Al2",
        /// Bit0 2D textures off, bit1 save calc. structures, bit2 show emitters, bit3 hide receivers, bit4 fog on, bit5 scene locked, bit6 final save, bit7 shape textures off.
        switches: Option<u8> = b"Var",
        /// Read only.
        switches_2: Option<u8> = b"Va2",
        switches_3: Option<u8> = b"Va3",
        acknowledgment: Option<Text> = b"Ack",
        max_tri_size: Option<f64> = b"_t2" / b"Mt2",
        /// Read only.
        old_max_tri: Option<f32> = b"Mts",
        min_rel_tri: Option<f64> = b"_rs" / b"Mrs",
        extension_string: Option<Text> = b"Rst",
        emission_colour: Option<Colour> = b"Evc",
        reception_colour: Option<Colour> = b"Wtc",
        scene_id: Option<Text> = b"Ups",
        /// Read only.
        pov: Option<[f32; 2]> = b"Pof",
        /// Read only.
        jobs: Option<(Text, Counted<Text>)> = b"Job",
        /// Save history records (i32 count5, 20 byte records), seen 2.6.6-3.4.0.
        history: Option<Rest<u8>> = b"Sh2",
    }

    /// Pages of the window.
    Views until b"EOO" {
        /// 8 slots, each Vwo or Nul.
        pages: Vec<Page> = b"Vwo",
        empty_pages: Vec<i32> = b"Nul",
        active_page: Option<i32> = b"Avi",
    }

    /// A page of the window.
    Page until b"EOO" {
        /// First.
        page_type: Option<i32> = b"Vw2",
        /// Read only.
        old_page_type: Option<i32> = b"Vwt",
        views: Vec<View> = b"Sv2",
        sizes_pos: Option<Counted<f64>> = b"_vr" / b"Fvr",
    }

    /// A view of a page.
    View until b"EOO" {
        linked_object: Option<i32> = b"Oid",
        /// Px, py, sx, sy.
        place: Option<[f64; 4]> = b"_ps" / b"Gps",
        render_mode: Option<i32> = b"Rem",
        va2: Option<u8> = b"Va2",
        va3: Option<u8> = b"Va3",
    }

    /// The picture of a scene or model.
    Thumbnail until b"EOO" {
        picture: Option<Rest<u8>> = b"Tm2",
        /// As Tm2, alpha stored scaled by 0.22508; read only.
        old_picture: Option<Rest<u8>> = b"Tmb",
    }

    /// Where a model stands and how large it is.
    ModelInfo until b"EOO" {
        /// X, y, z, qw, qx, qy, qz, bx, by, bz, step; model pose, bounding box, non-default translation step.
        pose_box_step: Option<(PositionFirst, [f64; 3], f64)> = b"_o2" / b"Mo2",
    }

    /// A collection that was kept with the scene, before 4.2.
    Collection until b"EOO" {
        name: Option<Text> = b"Grn",
        handle: Option<i32> = b"Gix",
        /// Bit0 overrides.
        flags: Option<u8> = b"Par",
        persistent_id: Option<Text> = b"Uis",
        elements: Vec<CollectionElement> = b"Asg",
    }

    /// An element of a collection.
    CollectionElement until b"EOO" {
        /// Object, handle.
        handles: Option<[i32; 2]> = b"Obj",
        kind: Option<u8> = b"Gty",
        /// Bit0 additive.
        flags: Option<u8> = b"Var",
    }
}
