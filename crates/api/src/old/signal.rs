//! `sim.*`: the old signals: scene-wide values in four independent kinds.
//!
//! They are signal properties of the scene under names of their own, so they have owners as those do.

use api_macro::api;

use crate::{ApiFn, Cx, Result, functions};
use scene::Namespace;
use scene::numbers;
use script::{Bytes, Number, OLD_SIGNALS, PropertyTarget, PropertyValue, Text};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    set_int32_signal,
    get_int32_signal,
    clear_int32_signal,
    set_float_signal,
    get_float_signal,
    clear_float_signal,
    set_double_signal,
    get_double_signal,
    clear_double_signal,
    set_string_signal,
    get_string_signal,
    clear_string_signal,
    get_signal_name,
];

/// The storage of each type of signal, by its number in `sim.getSignalName`.
const INT32: &str = OLD_SIGNALS[0];
const FLOAT: &str = OLD_SIGNALS[1];
const STRING: &str = OLD_SIGNALS[2];
const DOUBLE: &str = OLD_SIGNALS[3];

fn set<T: PropertyValue>(cx: &mut Cx, kind: &str, name: &str, value: T) -> i64 {
    let name = format!("signal.{kind}{name}");
    // As in CoppeliaSim, a name with spaces stores nothing and is no error.
    let _ = cx.write_property(&PropertyTarget::Scene, &name, (T::TYPE, value.into_data()));
    1
}

fn get<T: PropertyValue>(cx: &Cx, kind: &str, name: &str) -> Option<T> {
    let data = cx
        .read_property(
            &PropertyTarget::Scene,
            &format!("signal.{kind}{name}"),
            T::TYPE,
        )
        .ok()?;
    T::from_data(data)
}

/// Removes one signal of a kind, or all of them; returns how many there were.
fn clear(cx: &mut Cx, kind: &str, name: Option<&str>) -> i64 {
    let names = match name {
        Some(name) => vec![name.to_owned()],
        None => names_of(cx, kind),
    };
    let removed = names
        .iter()
        .map(|name| cx.remove_property(&PropertyTarget::Scene, &format!("signal.{kind}{name}")));
    numbers::count(removed.flatten().count())
}

/// Names of the signals of a kind in alphabetical order.
fn names_of(cx: &Cx, kind: &str) -> Vec<String> {
    let scene = cx.scene();
    let Ok(signals) = scene.named_values(None, Namespace::Signal) else {
        return Vec::new();
    };
    let names = signals.names().filter_map(|name| name.strip_prefix(kind));
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.sort();
    names
}

/// The functions of one type of signal: parameter type, result type, and the conversions to and from the stored value.
macro_rules! signals {
    ($($kind:ident: $set:ident $set_name:tt, $get:ident $get_name:tt, $clear:ident $clear_name:tt,
        $taken:ty, $given:ty, |$v:ident| $store:expr, |$s:pat_param| $load:expr;)*) => { $(
        /// Sets a signal.
        ///
        /// @param signalName a text without spaces
        /// @param signalValue the new value
        /// @return result 1
        #[api($set_name)]
        fn $set(cx: &mut Cx, signal_name: String, signal_value: $taken) -> Result<i64> {
            let $v = signal_value;
            Ok(set(cx, $kind, &signal_name, $store))
        }

        /// Value of a signal; nothing when there is none of that name.
        ///
        /// @param signalName its name
        /// @return signalValue
        #[api($get_name)]
        fn $get(cx: &Cx, signal_name: String) -> Result<Option<$given>> {
            Ok(get(cx, $kind, &signal_name).map(|$s| $load))
        }

        /// Removes a signal.
        ///
        /// @param signalName its name; without it, all of this kind are removed
        /// @return count how many there were
        #[api($clear_name)]
        fn $clear(cx: &mut Cx, #[default(None)] signal_name: Option<String>) -> Result<i64> {
            Ok(clear(cx, $kind, signal_name.as_deref()))
        }
    )* };
}

signals! {
    INT32: set_int32_signal "sim.setInt32Signal", get_int32_signal "sim.getInt32Signal",
        clear_int32_signal "sim.clearInt32Signal", Number, i64, |v| i64::from(numbers::low_i32(v.0)), |s| s;
    FLOAT: set_float_signal "sim.setFloatSignal", get_float_signal "sim.getFloatSignal",
        clear_float_signal "sim.clearFloatSignal", f64, f64, |v| v, |s| s;
    DOUBLE: set_double_signal "sim.setDoubleSignal", get_double_signal "sim.getDoubleSignal",
        clear_double_signal "sim.clearDoubleSignal", f64, f64, |v| v, |s| s;
    STRING: set_string_signal "sim.setStringSignal", get_string_signal "sim.getStringSignal",
        clear_string_signal "sim.clearStringSignal", Bytes, Text, |v| v, |Bytes(s)| Text(s);
}

/// Names of the signals one by one; nothing past the last one.
///
/// @param signalIndex from 0, in alphabetical order
/// @param signalType 0 int32, 1 float, 2 string, 3 double
/// @return signalName
#[api("sim.getSignalName")]
fn get_signal_name(cx: &Cx, signal_index: Number, signal_type: Number) -> Result<Option<String>> {
    let kind = usize::try_from(signal_type.0)
        .ok()
        .and_then(|at| OLD_SIGNALS.get(at));
    let (Some(kind), Ok(index)) = (kind, usize::try_from(signal_index.0)) else {
        return Ok(None);
    };
    Ok(names_of(cx, kind).into_iter().nth(index))
}
