//! Scripts.

use super::{Colour, OldCustomData, UserParams};
use crate::ttt::stream::streams;
use crate::ttt::value::{Counted, Rest, ScriptText, Text};

streams! {
    /// A script in the tree of objects, since 4.7.
    ScriptObject until b"EOO" {
        size: Option<f64> = b"Sos",
        /// Bit0 reset after simulation error.
        switches: Option<u8> = b"Var",
        colour: Option<Colour> = b"Soc",
        /// The script itself.
        script: Option<Script> = b"Soo",
    }

    /// A script.
    Script until b"EOO" {
        /// Reserved, object handle, script type; always first.
        ids: Option<[i32; 3]> = b"Si2",
        /// Bit0 threaded (old), bit1 disabled, bit3 clear=default main script(old), bit4 execute once(old), bit5.. see text.
        switches: Option<u8> = b"Va2",
        /// Bit0 3.1.4+ marker, bit2 parent is proxy.
        switches_2: Option<u8> = b"Va3",
        exec_order: Option<i32> = b"Seo",
        /// Read only.
        ttd: Option<i32> = b"Ttd",
        /// Obfuscated source text.
        text: Option<ScriptText> = b"Ste",
        modules: Option<Counted<Text>> = b"Pum",
        /// Read only.
        params: Option<UserParams> = b"Prm",
        cust_obj_handle: Option<i32> = b"Coc",
        old_custom_data: Option<OldCustomData> = b"Cod",
        /// Lua / python (since 4.7).
        lang: Option<Text> = b"Lne",
        /// Until 4.2.
        debug_level: Option<i32> = b"Dbl",
        /// I32 array (editor state), seen 3.2.0-3.5.0.
        editor_folding: Option<Rest<i32>> = b"Sfi",
        /// Seen 3.1.1-3.5.0: handle, -1.
        coi: Option<i32> = b"Coi",
    }
}
