//! Chunks of features that later versions removed.

use super::{Colour, TextureMapping, Volume};
use crate::ttt::stream::streams;
use crate::ttt::value::{Rest, Text};

streams! {
    /// A mirror or clipping plane, removed since.
    Mirror until b"EOO" {
        /// Width, height.
        size: Option<[f64; 2]> = b"_sz" / b"Msz",
        /// Bit0 active, bit1 clipping plane.
        cas: Option<u8> = b"Cas",
        clipped: Option<i32> = b"Clp",
        /// Reflectance, r, g, b.
        reflection: Option<[f32; 4]> = b"Mcr",
        colour: Option<Colour> = b"Cpc",
    }

    /// A mill, removed since.
    Mill until b"EOO" {
        /// 40 pyramid,41 cylinder,42 disc,43 cone.
        mill_type: Option<i32> = b"Snt",
        volume: Option<Volume> = b"Vod",
        size: Option<f64> = b"_ns" / b"Sns",
        /// Bit2 explicit.
        pra: Option<u8> = b"Pra",
        c1: Option<Colour> = b"Cl1",
        c2: Option<Colour> = b"Cl2",
        millable: Option<i32> = b"Sox",
    }

    /// Which calculations the old main script made.
    ModuleSettings until b"EOO" {
        /// Bit0 proximity sensors enabled.
        va5: Option<u8> = b"Va5",
        /// Bit1 mirrors off, bit2 clipping planes off, bit3 IK on.
        va2: Option<u8> = b"Va2",
        /// Bit1 collisions on, bit2 distances on, bit5 vision sensors off, bit6 mills off, bit7 (old) dynamics off.
        va3: Option<u8> = b"Va3",
        layers: Option<u16> = b"Al2",
        info_style: Option<i32> = b"Iwc",
        /// Read only.
        va1: Option<u8> = b"Va1",
        /// Read only.
        va4: Option<u8> = b"Va4",
        /// Step bullet, step ode; read only.
        old_steps: Option<[f32; 2]> = b"Ss2",
        /// Read only.
        old_bullet: Option<Rest<u8>> = b"Dsd",
        /// Read only.
        bullet_scale: Option<f32> = b"Dis",
        /// Read only.
        bullet_iter: Option<i32> = b"Dcs",
        /// Gx, gy, gz; read only.
        gravity: Option<[f32; 3]> = b"Gvy",
        /// Read only.
        old_ode_1: Option<Rest<u8>> = b"Od1",
        /// Read only.
        old_ode_2: Option<Rest<u8>> = b"Od2",
        /// Until 4.7.
        collision_colour: Option<Colour> = b"Crc",
        /// 2.6; read only.
        ddi: Option<i32> = b"Ddi",
        /// 2.6; read only.
        deu: Option<i32> = b"Deu",
        /// 2.6; read only.
        bcm: Option<f32> = b"Bcm",
    }

    /// A collision object, before 4.2.
    Collision until b"EOO" {
        contour_width: Option<i32> = b"Cwt",
        colour: Option<Colour> = b"Col",
        /// E1, e2, handle.
        entities_and_handle: Option<[i32; 3]> = b"Inx",
        name: Option<Text> = b"Nme",
        persistent_id: Option<Text> = b"Uis",
        flags: Option<u8> = b"Par",
    }

    /// A distance object, before 4.2.
    Distance until b"EOO" {
        /// E1, e2, handle.
        entities_and_handle: Option<[i32; 3]> = b"Inx",
        threshold: Option<f64> = b"_rh" / b"Trh",
        width: Option<i32> = b"Swt",
        colour: Option<Colour> = b"Col",
        flags: Option<u8> = b"Var",
        name: Option<Text> = b"Nme",
        persistent_id: Option<Text> = b"Uis",
    }

    /// A group of inverse kinematics, before 4.2.
    IkGroup until b"EOO" {
        handle: Option<i32> = b"Oid",
        name: Option<Text> = b"Nme",
        max_iter: Option<i32> = b"Mit",
        damping: Option<f64> = b"_pg" / b"Dpg",
        method: Option<i32> = b"Cmt",
        do_on: Option<i32> = b"Doo",
        flags: Option<u8> = b"Var",
        persistent_id: Option<Text> = b"Uis",
        elements: Vec<IkElement> = b"Ike",
        /// Until 4.0.
        constraints: Option<i32> = b"Ctr",
        /// Joint limit weight, avoidance weight; until 4.0.
        old_weights: Option<[f32; 2]> = b"Wgt",
        /// Joint thresh ang, joint thresh lin; until 4.0.
        old_thresholds: Option<[f32; 2]> = b"Jts",
        /// Avoid robot, avoid obstacle; until 4.0.
        old_avoidance: Option<[i32; 2]> = b"Avx",
        /// Until 4.0.
        avoid_threshold: Option<f32> = b"Avt",
        /// Until 4.0.
        flags2: Option<u8> = b"Va2",
    }

    /// An element of inverse kinematics, before 4.2.
    IkElement until b"EOO" {
        handle: Option<i32> = b"Oid",
        /// Tip, base.
        tip_and_base: Option<[i32; 2]> = b"Ik2",
        alt_base: Option<i32> = b"Abc",
        /// Ang prec, lin prec; degrees; read only.
        old_precisions: Option<[f32; 2]> = b"Prc",
        /// Ang prec, lin prec.
        precisions: Option<[f64; 2]> = b"_r2" / b"Pr2",
        constraints: Option<i32> = b"Ctr",
        /// Pos w, ori w.
        weights: Option<[f64; 2]> = b"_gt" / b"Wgt",
        flags: Option<u8> = b"Var",
    }

    /// A path planning task, before 4.2.
    PathPlanning until b"EOO" {
        /// Path, robot, obstacle.
        entities: Option<[i32; 3]> = b"Idx",
        goal: Option<i32> = b"Gid",
        start: Option<i32> = b"Pod",
        kind: Option<i32> = b"Ppt",
        hol_type: Option<i32> = b"Ttp",
        /// Step, ang step.
        steps: Option<[f64; 2]> = b"_ss" / b"Pss",
        ranges: Option<[f64; 8]> = b"_n2" / b"Rn2",
        min_turn: Option<f64> = b"_td" / b"Mtd",
        name: Option<Text> = b"Nme",
        handle: Option<i32> = b"Oid",
        max_time: Option<f64> = b"_xt" / b"Mxt",
        dirs: Option<[i32; 4]> = b"Sd2",
        flags: Option<u8> = b"Var",
        clearance: Option<f64> = b"_cl" / b"Ocl",
        max_dist: Option<f64> = b"_md" / b"Omd",
        passes: Option<i32> = b"Pp2",
        gamma: Option<[f64; 3]> = b"_aa" / b"Gaa",
    }

    /// Ghosts, removed since.
    Ghosts until b"NXT" {
        ghosts: Option<Rest<u8>> = b"_02" / b"V02",
        /// Read only.
        old_ghosts: Option<Rest<u8>> = b"V01",
    }

    /// A user interface of OpenGL, removed since.
    ButtonBlock until b"EOO" {
        rollup: Option<[i32; 4]> = b"Rus",
        name: Option<Text> = b"Bkn",
        attributes: Option<i32> = b"Att",
        handle: Option<i32> = b"Bkh",
        /// Cols, rows.
        cells: Option<[i32; 2]> = b"Bks",
        /// X, y.
        position: Option<[i32; 2]> = b"Bkp",
        /// Bw, bh.
        button_size: Option<[i32; 2]> = b"Bns",
        view: Option<i32> = b"Vew",
        object: Option<i32> = b"Aoi",
        buttons: Vec<Button> = b"Btn",
        texture: Option<TextureMapping> = b"Toj",
    }

    /// A button of such a user interface.
    Button until b"EOO" {
        /// Attr, id, len, height, x, y, label, down label, slider.
        look: Option<([i32; 6], Text, Text, f64)> = b"_va" / b"Bva",
        colours: Option<[f32; 9]> = b"Bnc",
        texture: Option<TextureMapping> = b"Toj",
    }

    /// A scene object of a class of its own (after 4.10).
    CustomSceneObject until b"EOO" {
        size: Option<f64> = b"_y2",
        colour: Option<Colour> = b"Cl0",
        flags: Option<u8> = b"Var",
    }

    /// Objects outside of the tree (after 4.10).
    CustomObjects until b"EOO" {
        objects: Vec<CustomObject> = b"Obj",
    }

    /// An object outside of the tree (after 4.10).
    CustomObject until b"EOO" {
        /// Handle, kind, meta info, prop count; i64 handle.
        identity: Option<(i64, Text, Text, i32)> = b"ob2",
        /// Name, data.
        properties: Vec<(Text, Text)> = b"pro",
    }
}
