//! The common part of scene objects.

use crate::ttt::stream::streams;
use crate::ttt::value::{Counted, OriginalReference, Rest, RotationFirst, Text};

streams! {
    /// Common data of all scene objects.
    Common until b"NXT" {
        /// A, b, c; signature 57,58,59; always first.
        signature: Option<[u8; 3]> = b"3do",
        /// Type string, e.g. shape, joint, or a user defined class name.
        object_type: Option<Text> = b"Ots",
        original_object_type: Option<Text> = b"Oot",
        /// Written under this tag but read back under Omi (so it never round-trips).
        meta_info: Option<Text> = b"Oma" | b"Omi",
        /// Local pose relative to parent.
        pose: Option<RotationFirst> = b"_fq" / b"Cfq",
        /// 16 bytes creation/licence record, seen in files of 2.6.6-3.3.0.
        creation_info: Option<Rest<u8>> = b"Cv2",
        /// Local pose to apply when assembled.
        assembly_pose: Option<RotationFirst> = b"_lt" / b"Alt",
        assembly: Option<(Counted<Text>, Counted<Text>)> = b"Am2",
        /// Am child, am parent; integer match values; 0 means "default"; read only.
        old_assembly: Option<[i32; 2]> = b"Amv",
        /// Handle, parent handle; old handle, old parent handle (-1 none).
        handles: Option<[i32; 2]> = b"Ids",
        /// Alias (since 4.3).
        alias: Option<Text> = b"Ali",
        /// Old alternative name.
        alt_name: Option<Text> = b"Anm",
        /// Old unique name, may contain #n suffix.
        name: Option<Text> = b"Nme",
        hierarchy_colour: Option<i32> = b"Hci",
        self_collision_indicator: Option<i32> = b"Sci",
        /// Property bits (bit 0x4 always set on write).
        object_property: Option<i32> = b"Op2",
        /// Switch bits, before 3.4.0.
        old_switches: Option<u8> = b"Var",
        /// Switch bits.
        switches_2: Option<u8> = b"Va2",
        /// Switch bits.
        switches: Option<u8> = b"Va3",
        /// Switch bits.
        locks: Option<u8> = b"Va4",
        /// Collidable/measurable/detectable/... bits.
        special_property: Option<i32> = b"Omp",
        /// Model override bits.
        model_property: Option<i32> = b"Mpo",
        /// Visibility layer bits.
        layer: Option<u16> = b"Lar",
        /// 0 first,1 normal,2 last.
        script_exec_priority: Option<i32> = b"Sep",
        /// Order among siblings.
        child_order: Option<i32> = b"Cor",
        /// Manip permissions, manip rel translation, manip step translation; i32 bits 0-2 x,y,z 3-5 rotations; i32 0 world,1 parent,2 own; f64 step.
        translation: Option<(i32, i32, f64)> = b"_m5" / b"Om5",
        /// Manip rel rotation, manip step rotation.
        rotation: Option<(i32, f64)> = b"_mr" / b"Omr",
        size_factor: Option<f64> = b"_fa" / b"Sfa",
        /// Size x, size y, size z; size values.
        size_values: Option<[f64; 3]> = b"_fb" / b"Sfb",
        /// Present only if not empty.
        custom_data: Option<CustomData> = b"Cda",
        /// Custom data, int header layout.
        old_custom_data: Option<OldCustomData> = b"Cod",
        /// Old script simulation parameters.
        user_params: Option<UserParams> = b"Lsp",
        references: Option<Counted<[i32; 3]>> = b"Crh",
        original_references: Option<Counted<OriginalReference>> = b"Orh",
        tagged_references: Vec<(Text, Counted<i32>)> = b"Cr2",
        tagged_original_references: Vec<(Text, Counted<(i32, Text)>)> = b"Or2",
        acknowledgment: Option<Text> = b"Ack",
        /// 16+ byte binary id shared by copies of a model.
        dna: Option<Text> = b"Ups",
        /// Unique persistent id.
        persistent_id: Option<Text> = b"Uis",
        transparent_offset: Option<f64> = b"_do" / b"Tdo",
        authorized_viewable: Option<i32> = b"Avo",
        extension_string: Option<Text> = b"Rst",
        /// Class-customisation properties (since 4.10).
        custom_properties: Option<CustomProperties> = b"Scp",
    }

    /// A colour.
    Colour until b"EOO" {
        /// Pre-3.1.4 colour model: ambient,diffuse,specular,emission,temperature.
        old_values: Option<[f32; 15]> = b"Cl2",
        /// Pre-3.1.3: ambient,diffuse,specular,emission; read only.
        oldest_values: Option<[f32; 12]> = b"Cls",
        /// Ambient/diffuse rgb, reserved rgb (light diffuse), specular rgb, emission rgb, temperature rgb.
        values: Option<[f32; 15]> = b"Cl3",
        /// Read only.
        shininess: Option<i32> = b"Shi",
        shininess_sh2: Option<i32> = b"Sh2",
        /// Value is the transparency factor as named in XML; 1 = opaque.
        opacity: Option<f32> = b"Trf",
        /// Bit2 not-transparent, bit4 flash, bit5 use simulation time.
        flags: Option<u8> = b"Var",
        /// Flash freq, flash ratio, flash phase.
        flash: Option<[f32; 3]> = b"Fi3",
        /// Colour name (matched by sim.setShapeColor etc.).
        name: Option<Text> = b"Cnm",
        extension_string: Option<Text> = b"Rst",
        /// Read only.
        pov_pattern: Option<i32> = b"Pov",
    }

    /// Custom data, since 4.3.
    CustomData until b"EOO" {
        blocks: Vec<(Text, Text)> = b"Cdt",
    }

    /// Custom data under numbers, before 4.3 and beside the new ones.
    OldCustomData until b"EOO" {
        /// I32 header, i32 len, len bytes; repeated.
        blocks: Vec<(i32, Text)> = b"Dat",
    }

    /// Parameters of a script that users may change.
    UserParams until b"EOO" {
        params: Option<Counted<(Text, Text, Text, i32)>> = b"Par",
    }

    /// Properties of a class of its own (after 4.10).
    CustomProperties until b"EOO" {
        /// Name, data; repeated; packed property value.
        properties: Vec<(Text, Text)> = b"pro",
    }
}
