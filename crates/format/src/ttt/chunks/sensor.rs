//! Sensors, cameras, lights.

use super::Colour;
use crate::ttt::stream::streams;
use crate::ttt::value::{Counted, Text};

streams! {
    /// A proximity sensor.
    ProximitySensor until b"EOO" {
        /// 30 pyramid,31 cylinder,32 disc,33 cone,34 ray.
        sensor_type: Option<i32> = b"Snt",
        volume: Option<Volume> = b"Vod",
        size: Option<f64> = b"_ns" / b"Sns",
        /// 0 = no angle check (since 4.8).
        angle_threshold: Option<f64> = b"al3",
        old_angle_threshold: Option<f64> = b"_l2" / b"Al2",
        /// Bit0 show volume, bit1 exact mode, bit2 angle limit on(old), bit4 no front faces, bit5 no back faces, bit6 show when detecting (old), bit7 explicit handling.
        switches: Option<u8> = b"Pr4",
        /// Bit0 occlusion check (old), bit1 randomised detection.
        switches_2: Option<u8> = b"Pr5",
        /// Rand samples, rand count.
        randomized: Option<[i32; 2]> = b"Rad",
        /// Volume colour.
        colour: Option<Colour> = b"Cl1",
        /// Read only.
        second_colour: Option<Colour> = b"Cl2",
        /// Ray colour.
        colour3: Option<Colour> = b"Cl3",
        /// Read only.
        colour4: Option<Colour> = b"Cl4",
        /// Entity to detect, -1 all.
        detectable: Option<i32> = b"Sox",
        sensable_type: Option<i32> = b"Sst",
    }

    /// Where a sensor looks.
    Volume until b"EOO" {
        /// 0 pyramid,1 cylinder,2 disc,3 cone,4 ray.
        volume_type: Option<i32> = b"Snt",
        /// Offset, range, x size, y size, x size far, y size far, radius, radius far, angle.
        sizes: Option<[f64; 9]> = b"_s3" / b"Ss3",
        inside_angle: Option<f64> = b"_ia" / b"Sia",
        /// Faces, faces far, subdiv, subdiv far.
        faces: Option<[i32; 4]> = b"Ssi",
        /// 0 = disabled (since 4.8).
        smallest_distance: Option<f64> = b"at2",
        old_smallest_distance: Option<f64> = b"_tf" / b"Wtf",
        /// Bit0 smallest distance enabled.
        switches: Option<u8> = b"Par",
        planes_inside: Option<Counted<f64>> = b"_c0" / b"Nc0",
        planes_outside: Option<Counted<f64>> = b"_c1" / b"Nc1",
        normals_inside: Option<Counted<f64>> = b"_c2" / b"Nc2",
        normals_outside: Option<Counted<f64>> = b"_c3" / b"Nc3",
        edges: Option<Counted<f64>> = b"_c4" / b"Nc4",
        /// Until 3.0.
        nc6: Option<Counted<f32>> = b"Nc6",
        non_detect_edges: Option<Counted<f64>> = b"_c5" / b"Nc5",
    }

    /// A vision sensor.
    VisionSensor until b"EOO" {
        /// Ortho size, view angle, near, far.
        optics: Option<[f64; 4]> = b"_cp" / b"Ccp",
        /// Res x, res y.
        resolution: Option<[i32; 2]> = b"Res",
        /// Entity to render, -1 all.
        renderable: Option<i32> = b"Dox",
        /// Def r, def g, def b; default buffer value.
        default_buffer: Option<[f32; 3]> = b"Db2",
        size: Option<f64> = b"_i2" / b"Si2",
        /// Size, sy, sz; read only.
        old_size: Option<[f32; 3]> = b"Siz",
        render_mode: Option<i32> = b"Rmd",
        render_attributes: Option<i32> = b"Afr",
        /// Bit0 perspective, bit1 explicit, bit2 hide fog, bit4 show frustum, bit6 local lights, bit7 env background.
        switches_3: Option<u8> = b"Va3",
        /// Bit0 external image, bit1 ignore rgb, bit2 ignore depth, bit4 no basic stats.
        switches_2: Option<u8> = b"Va2",
        /// Read only.
        switches: Option<u8> = b"Var",
        /// Read only.
        pov: Option<([f32; 2], i32)> = b"Pv1",
        colour: Option<Colour> = b"Cl1",
        /// Read only.
        second_colour: Option<Colour> = b"Cl2",
        /// Read only.
        colour3: Option<Colour> = b"Cl3",
        /// Until 3.2.
        colour4: Option<Colour> = b"Cl4",
        /// Vision filter chain (3.x); read only.
        filter: Option<FilterChain> = b"Cfr",
    }

    /// The image filters of 3.x.
    FilterChain until b"EOO" {
        /// Read only.
        filters: Vec<Filter> = b"Sfr",
    }

    /// One image filter of 3.x.
    Filter until b"EOO" {
        /// Filter type, custom header, custom id; read only.
        kind: Option<[i32; 3]> = b"Sft",
        /// Read only.
        version: Option<i32> = b"Sfv",
        /// Read only.
        name: Option<Text> = b"Cfn",
        /// Read only.
        bytes: Option<Counted<u8>> = b"Pab",
        /// Read only.
        ints: Option<Counted<i32>> = b"Pai",
        /// Read only.
        floats: Option<Counted<f32>> = b"Paf",
        /// Read only.
        custom: Option<Counted<u8>> = b"Cfp",
        /// Read only.
        enabled: Option<u8> = b"Sfe",
    }

    /// A camera.
    Camera until b"EOO" {
        /// Tracked, size.
        tracked_and_size: Option<(i32, f64)> = b"_p4" / b"Cp4",
        /// Ortho size, view angle.
        optics: Option<[f64; 2]> = b"_p3" / b"Cp3",
        /// Near, far.
        clipping: Option<[f64; 2]> = b"_cp" / b"Ccp",
        manip: Option<i32> = b"Cmp",
        old_render_mode: Option<i32> = b"Rmd",
        render_mode: Option<i32> = b"Rm2",
        /// -1 unset,0 ortho,1 perspective.
        cpm: Option<i32> = b"Cpm",
        /// Read only.
        caz: Option<u8> = b"Caz",
        /// Written 4.3.0-4.5.1, always 0; reserved; read only.
        rcm: Option<i32> = b"Rcm",
        /// Bit0 parent is manipulation proxy, bit1 hide fog, bit2 local lights, bit3 no picking, bit5 only during simulation, bit6 only during recording, bit7 show volume.
        switches: Option<u8> = b"Ca2",
        /// Bit0 view mode set(old), bit1 perspective.
        switches_2: Option<u8> = b"Ca3",
        /// Read only.
        pov: Option<([f32; 2], i32)> = b"Pv1",
        colour: Option<Colour> = b"Cl1",
        /// Read only.
        second_colour: Option<Colour> = b"Cl2",
    }

    /// A light.
    Light until b"EOO" {
        /// Light type, spot exponent, size.
        kind_and_size: Option<([i32; 2], f64)> = b"_p2" / b"Cp2",
        spot_cutoff: Option<f64> = b"_p3" / b"Cp3",
        /// Att c, att l, att q.
        attenuation: Option<[f64; 3]> = b"_af" / b"Caf",
        /// Bit0 active, bit1 local, bit2 (old) no POV shadow.
        switches: Option<u8> = b"Cas",
        /// Read only.
        pov_fade: Option<f32> = b"Pfd",
        colour: Option<Colour> = b"Cl1",
        light_colour: Option<Colour> = b"Cl2",
    }
}
