//! Graphs and their curves.

use super::Colour;
use crate::ttt::stream::streams;
use crate::ttt::value::{Counted, Rest, Text};

streams! {
    /// A graph.
    Graph until b"EOO" {
        size: Option<f64> = b"_hg" / b"Ghg",
        colour: Option<Colour> = b"Cl0",
        /// Background rgb, foreground rgb.
        bgfg: Option<[f32; 6]> = b"Cl1",
        /// Buffer size, point count.
        buffer: Option<[i32; 2]> = b"Gbv",
        times: Option<Rest<f64>> = b"_td" / b"Gtd",
        /// Data stream.
        streams: Vec<DataStream> = b"Dst",
        /// Xy/xyz curve.
        curves: Vec<Curve> = b"Cuv",
        old_streams: Vec<OldDataStream> = b"Ghd",
        old_curves_3d: Vec<OldCurve> = b"Gh3",
        old_curves_2d: Vec<OldCurve> = b"Gh2",
        old_static: Vec<OldStaticCurve> = b"Sta",
        /// Bit0 cyclic, bit1 planes, bit2 grid, bit3 values, bit4 explicit.
        gps: Option<u8> = b"Gps",
    }

    /// Values over time, since 4.2.
    DataStream until b"EOO" {
        /// Name, unit.
        name_and_unit: Option<(Text, Text)> = b"Nme",
        id: Option<i32> = b"Oid",
        script: Option<i32> = b"Sch",
        /// R, g, b.
        colour: Option<[f32; 3]> = b"Col",
        /// Transf, mult, off, ma period, cyclic range.
        transformation: Option<(i32, [f64; 2], i32, f64)> = b"_ar" / b"Var",
        /// Bit0 visible, bit1 label, bit2 linked, bit4 static.
        flags: Option<u8> = b"Pa0",
        /// Per point: f64 value, f64 transformed, u8 valid, u8 transformed valid.
        data: Option<Rest<u8>> = b"_ts" / b"Pts",
        static_values: Option<Counted<f64>> = b"_ps" / b"Sps",
    }

    /// A curve in two or three dimensions, since 4.2.
    Curve until b"EOO" {
        /// Name, unit.
        name_and_unit: Option<(Text, Text)> = b"Nme",
        /// Id, dim, width.
        id_dim_width: Option<[i32; 3]> = b"Oid",
        script: Option<i32> = b"Sch",
        /// R, g, b.
        colour: Option<[f32; 3]> = b"Col",
        /// Dx, dy, dz.
        offsets: Option<[f64; 3]> = b"_ev" / b"Dev",
        /// S1, s2, s3.
        streams: Option<[i32; 3]> = b"Str",
        /// Bit0 relative to graph, bit1 label, bit2 linked, bit3 static.
        flags: Option<u8> = b"Pa0",
        static_values: Option<Counted<f64>> = b"_ts" / b"Pts",
    }

    /// Values over time, before 4.2.
    OldDataStream until b"EOO" {
        name: Option<Text> = b"Nme",
        id: Option<i32> = b"Oid",
        /// Data type, data obj, data aux.
        source: Option<[i32; 3]> = b"Dt2",
        /// R, g, b.
        colour: Option<[f32; 3]> = b"Col",
        /// Zoom, off.
        zoom_and_offset: Option<[f64; 2]> = b"_ar",
        /// Zoom, nothing, offset; before 4.5.
        old_zoom_and_offset: Option<[f32; 3]> = b"Var",
        ma_count: Option<i32> = b"Mac",
        transf: Option<i32> = b"Dci",
        flags: Option<u8> = b"Pa2",
        data: Option<Rest<f64>> = b"_t9" / b"Dt9",
        tdata: Option<Rest<f64>> = b"_fd" / b"Ifd",
        valid: Option<Rest<u8>> = b"Bla",
        tvalid: Option<Rest<u8>> = b"Bli",
    }

    /// A curve in two or three dimensions, before 4.2.
    OldCurve until b"EOO" {
        name: Option<Text> = b"Nme",
        id: Option<i32> = b"Oid",
        colour: Option<Colour> = b"Cl2",
        /// Read only.
        old_colours: Option<[f32; 6]> = b"Col",
        /// A, b, c.
        streams: Option<[i32; 3]> = b"Did",
        width: Option<f64> = b"_dw" / b"3dw",
        flags: Option<u8> = b"Par",
    }

    /// A curve that does not move, before 4.2.
    OldStaticCurve until b"EOO" {
        /// I32 type, 3 f32 rgb, string name, i32|f64 width.
        info: Option<(i32, [f32; 3], Text, i32)> = b"Ilo",
        emissive: Option<[f32; 3]> = b"Il2",
        flags: Option<u8> = b"Par",
        values: Option<Counted<f64>> = b"_al" / b"Val",
    }
}
