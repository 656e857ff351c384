//! The rows of the symbols that plugins call: names, parameters and results, as C declares them.
//!
//! This file is part of the library and of its build script, which makes the C part from the same rows.
//!
//! A row has four columns: symbol, result, parameters, function.
//! - Results: `v` nothing; `k` 1 if the call succeeded; `i` and `l` the first result as an integer, 1 without one; `r` the same, and the
//!   parameters get the others; `n` a new object, which gets the name that it has in V-REP; `q` whether there is a result; `d` and `f` a
//!   number, `double` or `float`; `S`, `P`, `I`, `D`, `F` bytes, memory, integers, numbers or floats that the caller releases; `V` and `W`
//!   floats and doubles that the caller does not release, valid until the next call of the function. Where the call fails: -1, -1.0 or NULL.
//! - Parameters: `i` int, `l` long long, `d` double, `b` bool, `B` an int that means a bool, `s` text (`t#`: also where its length
//!   is 0), nil for NULL, `w` the same where NULL is an error, `p` an address (`>p`: the function writes there), `c` a callback. `d3`
//!   points to three numbers, `d#` to as many as the next parameter says; `u`, `f` are bytes and floats. `>` before them: the host
//!   writes there. `=`: it reads and writes. `>#`: the length of what is returned. `>S`, `>I`, `>L`, `>D`, `>F`: what is returned, by
//!   pointer.
//! - Functions: `sim.name` is called with the parameters, or with those that are listed after it, counted from 0 (`-` for none); `-` is missing;
//!   everything else is in `functions` or `scene_functions`.

/// A symbol of the C interface.
#[derive(Debug, Clone, PartialEq)]
pub struct Symbol {
    /// Its name in C.
    pub symbol: &'static str,
    /// The letter of the result.
    pub result: char,
    /// The parameters in C, a list and its count as one.
    pub params: Vec<Param>,
    /// The function behind it.
    pub function: &'static str,
    /// Which parameters the function gets; None for all.
    pub order: Option<Vec<usize>>,
}

/// One parameter: one or, with a count, two of C's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Param {
    /// The host reads it.
    pub is_in: bool,
    /// The host writes it.
    pub is_out: bool,
    /// The letter of the type; `#` for a length.
    pub ty: char,
    /// How many values there are.
    pub size: Size,
}

/// How many values there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// One, by value where the host only reads it.
    One,
    /// So many behind a pointer.
    Fixed(usize),
    /// As many as the next parameter in C says.
    Counted,
}

/// All symbols of the table `text`, in its order.
pub fn rows(text: &'static str) -> Vec<Symbol> {
    text.lines()
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .map(Symbol::parse)
        .collect()
}

impl Symbol {
    fn parse(line: &'static str) -> Self {
        let mut columns = line.split('\t');
        let mut next = || columns.next().unwrap_or_default();
        let (symbol, result, params, function) = (next(), next(), next(), next());
        let (function, order) = match function.split_once(' ') {
            Some((name, order)) => (
                name,
                Some(
                    order
                        .split(',')
                        .filter_map(|place| place.parse().ok())
                        .collect(),
                ),
            ),
            None => (function, None),
        };
        let params = params
            .split(',')
            .filter(|param| !param.is_empty())
            .map(Param::parse)
            .collect();
        Self {
            symbol,
            result: result.chars().next().unwrap_or('v'),
            params,
            function,
            order,
        }
    }

    /// Whether it only says that it is missing.
    pub fn is_missing(&self) -> bool {
        self.function == "-"
    }

    /// The type of the result in C.
    pub fn c_result(&self) -> &'static str {
        match self.result {
            'v' => "void",
            'd' => "double",
            'f' => "float",
            'l' => "long long int",
            'S' => "char*",
            'P' | 'V' | 'W' => "void*",
            'I' => "int*",
            'D' => "double*",
            'F' => "float*",
            _ => "int",
        }
    }

    /// Whether the result is an address.
    pub fn returns_pointer(&self) -> bool {
        matches!(self.result, 'S' | 'P' | 'I' | 'D' | 'F' | 'V' | 'W')
    }

    /// The parameters in C, with the names `a`, `b`, ... and `n` before the name for counts.
    pub fn c_params(&self) -> String {
        let params: Vec<String> = self
            .params
            .iter()
            .enumerate()
            .map(|(place, param)| param.c_text(place))
            .collect();
        if params.is_empty() {
            "void".to_owned()
        } else {
            params.join(", ")
        }
    }
}

impl Param {
    fn parse(text: &str) -> Self {
        let (is_in, is_out, rest) = match text.strip_prefix('>') {
            Some(rest) => (false, true, rest),
            None => text
                .strip_prefix('=')
                .map_or((true, false, text), |rest| (true, true, rest)),
        };
        let ty = rest.chars().next().unwrap_or('p');
        let size = match &rest[ty.len_utf8()..] {
            "#" => Size::Counted,
            digits => digits.parse().map_or(Size::One, Size::Fixed),
        };
        Self {
            is_in,
            is_out,
            ty,
            size,
        }
    }

    /// Whether C passes an address.
    pub fn is_pointer(&self) -> bool {
        self.is_out || self.size != Size::One || matches!(self.ty, 's' | 't' | 'w' | 'p' | 'c')
    }

    fn c_type(&self) -> &'static str {
        match self.ty {
            'l' => "long long int",
            'd' => "double",
            'f' => "float",
            'u' => "unsigned char",
            'b' => "bool",
            's' | 't' | 'w' => "char",
            'S' => "char*",
            'I' => "int*",
            'L' => "long long int*",
            'D' => "double*",
            'F' => "float*",
            'p' => "void",
            _ => "int",
        }
    }

    fn c_text(&self, place: usize) -> String {
        let name = name(place);
        if self.ty == 'c' {
            return format!("void (*{name})(struct SScriptCallBack*)");
        }
        let constant = if self.is_out { "" } else { "const " };
        let value = match self.is_pointer() {
            true => format!("{constant}{}* {name}", self.c_type()),
            false => format!("{} {name}", self.c_type()),
        };
        if self.size == Size::Counted {
            format!("{value}, int n{name}")
        } else {
            value
        }
    }
}

/// The name of a parameter in C.
pub fn name(place: usize) -> char {
    char::from(b'a' + u8::try_from(place).unwrap_or(25).min(25))
}
