//! A call of a plugin: its parameters become values, the function is called, the results are written where C wants them.

use heap::Lazy;
use std::sync::atomic::{AtomicBool, Ordering};

use super::current::{Frame, current};
use super::ffi::Value;
use super::functions::{self, Function};
use super::signature::{self, Param, Size, Symbol};
use scene::Data;
use scene::numbers;

/// Longest list a plugin may pass; a larger count is a mistake.
const MAX_ITEMS: usize = Data::MAX_ITEMS;

/// A symbol with the function behind it.
struct Bound {
    row: Symbol,
    target: Target,
    /// Whether the numbers of lists are doubles.
    is_double: bool,
}

enum Target {
    /// A function of scripts.
    Api(&'static str),
    Own(Function),
    /// Starts or ends a simulator, which plugins cannot do.
    Launch,
    Missing,
}

impl Symbol {
    /// Whether it is a function of scripts, `sim.name` or `simName`, or one of ours beside them.
    pub fn is_of_scripts(&self) -> bool {
        let name = self.function.strip_prefix("sim");
        name.is_some_and(|name| name.starts_with(|c: char| c == '.' || c.is_ascii_uppercase()))
            || self.function.starts_with("swanilda.")
    }

    /// Whether it starts or ends a simulator, which plugins cannot do.
    pub fn is_launch(&self) -> bool {
        self.function.starts_with("launch.")
    }
}

/// A version of the interface: its symbols, with the functions behind them.
pub struct Interface(Vec<Bound>);

/// What programs call that load the library of CoppeliaSim 4.1, whose numbers have single precision. `launch` has the functions that
/// start and end a simulator.
pub fn interface_41(launch: &[(&'static str, Function)]) -> Interface {
    Interface::new(include_str!("symbols_41.tsv"), launch, false)
}

/// The same of CoppeliaSim 4.10, whose numbers have double precision: what plugins call, and `launch`.
pub fn interface_410(launch: &[(&'static str, Function)]) -> Interface {
    Interface::new(include_str!("symbols_410.tsv"), launch, true)
}

/// What plugins call: the interface of CoppeliaSim 4.10.
pub fn plugin_interface() -> &'static Interface {
    static INTERFACE: Lazy<Interface> = Lazy::new(|| interface_410(&[]));
    &INTERFACE
}

impl Interface {
    /// The interface of a table of symbols. Its functions are in `own`, in this crate, or those of scripts.
    fn new(table: &'static str, own: &[(&'static str, Function)], is_double: bool) -> Self {
        let target = |row: &Symbol| {
            let own = own.iter().find(|(name, _)| *name == row.function);
            match own
                .map(|own| own.1)
                .or_else(|| functions::find(row.function))
            {
                Some(function) => Target::Own(function),
                None if row.is_launch() => Target::Launch,
                None if row.is_of_scripts() => Target::Api(row.function),
                None => Target::Missing,
            }
        };
        let rows = signature::rows(table).into_iter();
        Self(
            rows.map(|row| Bound {
                target: target(&row),
                row,
                is_double,
            })
            .collect(),
        )
    }

    /// All symbols.
    pub fn symbols(&self) -> impl Iterator<Item = &Symbol> {
        self.0.iter().map(|bound| &bound.row)
    }

    /// Performs the call of symbol `number`; its result as C returns it.
    pub(super) fn perform(&self, number: u32, values: &mut [Value]) -> i64 {
        let Some(bound) = self.0.get(number as usize) else {
            return -1;
        };
        let Some(frame) = current() else {
            warn_of_thread(bound.row.symbol);
            return bound.failure();
        };
        answer(&frame, bound, values).unwrap_or_else(|reason| {
            frame.note_failure(&bound.row, reason);
            bound.failure()
        })
    }

    /// What a call of symbol `number` that failed returns.
    pub(super) fn failure(&self, number: u32) -> i64 {
        self.0.get(number as usize).map_or(-1, Bound::failure)
    }

    /// The symbols whose functions do not exist although their rows do not say so.
    pub fn unbound(&self) -> impl Iterator<Item = &'static str> {
        let is_unbound =
            |bound: &&Bound| matches!(bound.target, Target::Missing) && !bound.row.is_missing();
        self.0
            .iter()
            .filter(is_unbound)
            .map(|bound| bound.row.symbol)
    }
}

impl Bound {
    fn failure(&self) -> i64 {
        if self.row.returns_pointer() { 0 } else { -1 }
    }
}

/// What a function of the interface gets.
pub struct Call<'a> {
    /// Who calls.
    pub frame: &'a Frame,
    /// The name of the function in C.
    pub(super) symbol: &'static str,
    /// The parameters that it reads, and the counts of those that it fills.
    pub args: Vec<Data>,
    /// As C passed them.
    pub(super) values: &'a [Value],
    /// Whether the numbers of lists are doubles.
    pub(super) is_double: bool,
}

/// Calls from threads of the plugin's own, or after the simulator has ended.
fn warn_of_thread(symbol: &str) {
    static HAS_WARNED: AtomicBool = AtomicBool::new(false);
    if !HAS_WARNED.swap(true, Ordering::Relaxed) {
        eprintln!(
            "swanilda: a plugin called {symbol} outside of a call by the simulator, for instance from a thread of its own. Such calls fail."
        );
    }
}

fn answer(frame: &Frame, bound: &Bound, values: &mut [Value]) -> Result<i64, String> {
    let row = &bound.row;
    let args = if row.is_missing() {
        Vec::new()
    } else {
        read(row, values)?
    };
    let results = match bound.target {
        Target::Missing => return Err("it is not implemented in Swanilda".into()),
        Target::Launch => {
            return Err("only programs that load the simulator as a library may call it".into());
        }
        Target::Own(function) => function(&Call {
            frame,
            symbol: row.symbol,
            args,
            values,
            is_double: bound.is_double,
        })?,
        Target::Api(name) => frame.host.call(name, &ordered(row, args))?,
    };
    write(frame, row, values, results)
}

fn ordered(row: &Symbol, args: Vec<Data>) -> Vec<Data> {
    match &row.order {
        Some(order) => order
            .iter()
            .map(|&place| args.get(place).cloned().unwrap_or(Data::Nil))
            .collect(),
        None => args,
    }
}

/// The parameters that the host reads, and the counts of those that it fills.
fn read(row: &Symbol, values: &[Value]) -> Result<Vec<Data>, String> {
    let mut args = Vec::new();
    for (param, value) in row.params.iter().zip(values) {
        if param.is_in {
            args.push(argument(*param, value)?);
        } else if param.size == Size::Counted {
            args.push(Data::Int(numbers::count(count_of(*param, value)?)));
        }
    }
    Ok(args)
}

fn count_of(param: Param, value: &Value) -> Result<usize, String> {
    match param.size {
        Size::One => Ok(1),
        Size::Fixed(count) => Ok(count),
        Size::Counted => {
            let count = usize::try_from(value.integer)
                .ok()
                .filter(|&count| count <= MAX_ITEMS);
            count.ok_or_else(|| format!("{} is no number of values", value.integer))
        }
    }
}

fn argument(param: Param, value: &Value) -> Result<Data, String> {
    let count = count_of(param, value)?;
    let text = || value.address.text().map_or(Data::Nil, Data::Text);
    Ok(match (param.ty, param.size) {
        ('s', Size::One) => text(),
        ('w', _) if value.address.is_null() => return Err("NULL was passed for a text".into()),
        ('w', _) => text(),
        ('t', _) if count == 0 => text(),
        ('s' | 't', _) => Data::Text(list::<u8>(value, count)?),
        ('p', _) if value.address.is_null() => Data::Nil,
        ('p' | 'c', _) => Data::Int((value.address.number() as u64).cast_signed()),
        ('i' | 'l', Size::One) => Data::Int(value.integer),
        ('b' | 'B', Size::One) => Data::Bool(value.integer != 0),
        ('d' | 'f', Size::One) => Data::Float(value.number),
        // Arrays of a fixed size are optional.
        (_, Size::Fixed(_)) if value.address.is_null() => Data::Nil,
        ('u', _) => Data::Buffer(list::<u8>(value, count)?),
        ('i', _) => list::<i32>(value, count)?
            .into_iter()
            .map(i64::from)
            .collect::<Vec<_>>()
            .into(),
        ('l', _) => list::<i64>(value, count)?.into(),
        ('f', _) => list::<f32>(value, count)?
            .into_iter()
            .map(f64::from)
            .collect::<Vec<_>>()
            .into(),
        _ => list::<f64>(value, count)?.into(),
    })
}

fn list<T: super::ffi::Plain>(value: &Value, count: usize) -> Result<Vec<T>, String> {
    if count == 0 {
        return Ok(Vec::new());
    }
    value
        .address
        .read(count)
        .ok_or_else(|| format!("NULL was passed for {count} values"))
}

/// Writes results to the places the plugin named; what the function returns.
fn write(
    frame: &Frame,
    row: &Symbol,
    values: &mut [Value],
    results: Vec<Data>,
) -> Result<i64, String> {
    if row.result == 'q' && results.first().is_none_or(|first| *first == Data::Nil) {
        return Ok(0);
    }
    let mut results = results.into_iter();
    let mut length = 0;
    let returned = match row.result {
        'v' | 'k' | 'q' => 1,
        'd' | 'f' => {
            let number = results
                .next()
                .as_ref()
                .and_then(Data::as_f64)
                .ok_or("there is no number")?;
            values
                .last_mut()
                .into_iter()
                .for_each(|last| last.number = number);
            1
        }
        'S' | 'P' | 'I' | 'D' | 'F' => frame.keep(row.result, results.next(), &mut length),
        'V' => frame.lend(row.symbol, 'F', results.next(), &mut length),
        'W' => frame.lend(row.symbol, 'D', results.next(), &mut length),
        'n' => named(frame, results.next())?,
        _ => results.next().map_or(1, |first| integer(&first)),
    };
    let mut places = row
        .params
        .iter()
        .zip(&*values)
        .filter(|(param, _)| param.is_out && param.ty != 'p');
    places.try_for_each(|(param, value)| fill(frame, *param, value, &mut results, &mut length))?;
    Ok(returned)
}

/// The handle of a new object, which gets the name that it has in V-REP.
fn named(frame: &Frame, object: Option<Data>) -> Result<i64, String> {
    let object = object.ok_or("there is no object")?;
    let handle = integer(&object);
    frame.host.call("swanilda.library.giveOldName", &[object])?;
    Ok(handle)
}

/// Writes the next result, or the length of the one before.
fn fill(
    frame: &Frame,
    param: Param,
    value: &Value,
    results: &mut impl Iterator<Item = Data>,
    length: &mut usize,
) -> Result<(), String> {
    match param.ty {
        '#' => value
            .address
            .write(&[i32::try_from(*length).unwrap_or(i32::MAX)]),
        'S' | 'I' | 'L' | 'D' | 'F' => {
            frame.keep_at(value.address, param.ty, results.next(), length);
        }
        // Output arguments without a result keep their values.
        _ => {
            return results
                .next()
                .map_or(Ok(()), |result| fill_numbers(param, value, &result));
        }
    }
    Ok(())
}

/// Writes as many numbers as there are and as there is room for.
fn fill_numbers(param: Param, value: &Value, result: &Data) -> Result<(), String> {
    let items = match result {
        Data::Nil => return Ok(()),
        Data::Array(items) => items.as_slice(),
        single => std::slice::from_ref(single),
    };
    let items = &items[..items.len().min(count_of(param, value)?)];
    let integers = || items.iter().map(integer);
    let floats = || items.iter().map(|item| item.as_f64().unwrap_or_default());
    match param.ty {
        'u' | 'b' => value.address.write(
            &integers()
                .map(|item| item.to_le_bytes()[0])
                .collect::<Vec<_>>(),
        ),
        'i' => value
            .address
            .write(&integers().map(numbers::low_i32).collect::<Vec<_>>()),
        'l' => value.address.write(&integers().collect::<Vec<_>>()),
        'f' => value
            .address
            .write(&floats().map(numbers::single).collect::<Vec<_>>()),
        _ => value.address.write(&floats().collect::<Vec<_>>()),
    }
    Ok(())
}

/// As C converts it; what is no number is 1, as a call that succeeded.
pub(super) fn integer(data: &Data) -> i64 {
    match *data {
        Data::Int(value) => value,
        Data::Float(value) => numbers::truncated(value),
        Data::Bool(value) => i64::from(value),
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::{Interface, Param, Size, Symbol, interface_41, plugin_interface};

    #[test]
    fn every_row_names_a_function_or_says_that_it_is_missing() {
        assert_eq!(plugin_interface().unbound().collect::<Vec<_>>(), [""; 0]);
        assert_eq!(of_41().unbound().collect::<Vec<_>>(), [""; 0]);
    }

    fn of_41() -> Interface {
        interface_41(&[])
    }

    /// How parameters and results are passed: `i` int, `b` bool, `l` 64 bits, `f` float, `d` double, `p` an address, `v` nothing.
    fn convention(symbol: &Symbol) -> (char, String) {
        let result = match symbol.result {
            _ if symbol.returns_pointer() => 'p',
            kind @ ('v' | 'd' | 'f' | 'l') => kind,
            _ => 'i',
        };
        (
            result,
            symbol
                .params
                .iter()
                .flat_map(|param| passed(*param))
                .collect(),
        )
    }

    fn passed(param: Param) -> Vec<char> {
        let count = (param.size == Size::Counted).then_some('i');
        let value = match param.ty {
            _ if param.is_pointer() => 'p',
            kind @ ('l' | 'd' | 'f' | 'b') => kind,
            _ => 'i',
        };
        std::iter::once(value).chain(count).collect()
    }

    /// `abi_41.tsv` has what the declarations of programs say.
    #[test]
    fn programs_for_41_find_every_function_with_the_parameters_that_they_pass() {
        let interface = of_41();
        let mut symbols = interface.symbols();
        for line in include_str!("abi_41.tsv").lines() {
            let mut columns = line.split('\t');
            let mut column = || columns.next().unwrap_or_default();
            let (name, result, params) = (column(), column(), column());
            let symbol = symbols.next().expect("as many symbols as declarations");
            assert_eq!(symbol.symbol, name);
            let (own_result, own_params) = convention(symbol);
            let own_result = if result == "b" { 'b' } else { own_result };
            assert_eq!(own_result.to_string(), result, "the result of {name}");
            if !symbol.is_missing() {
                assert_eq!(own_params, params, "the parameters of {name}");
            }
        }
        assert!(symbols.next().is_none(), "more symbols than declarations");
    }
}
