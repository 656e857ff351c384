//! Functions in front of old scripts, for what does the same no longer. They stay in one line with the text behind them, so that the
//! numbers of its lines stay.

use super::old_names::is_part;

const COMPUTE: &str = "simOMPL.compute";
/// Planning began with a setup of its own. The function is a tail call: errors name the line of the script.
const SETUP_AND_COMPUTE: &str = "function setupAndCompute(simOMPL) return function(task,...) simOMPL.setup(task) return simOMPL.compute(task,...) end end ";

/// In Lua 5.1 numbers with fractions, and texts of numbers, were truncated where integers are needed, and `%u` was an integer too.
/// Errors name the line of the script that calls.
const FORMAT: &str = "do local math,table,type,tonumber,error,pcall=math,table,type,tonumber,error,pcall \
local format,find,gsub=string.format,string.find,string.gsub \
local function truncated(v) local x=math.type(v)=='integer' and v or tonumber(v) if math.type(x)~='float' then return x or v end \
if x~=x or x<-2^63 or x>=2^63 then return math.mininteger end return math.tointeger(x<0 and math.ceil(x) or math.floor(x)) end \
local function checked(ok,text) if ok then return text end error((gsub(text,\"'%?'\",\"'format'\",1)),2) end \
function string.format(text,...) local v,n=table.pack(...),0 \
if type(text)=='string' then text=gsub(text,'%%([-+ #0-9.]*)(.)',function(flags,kind) if kind=='%' and flags=='' then return end n=n+1 \
if find(kind,'[diuoxXc]') then v[n]=truncated(v[n]) return '%'..flags..(kind=='u' and 'd' or kind) end end) end \
return checked(pcall(format,text,table.unpack(v,1,v.n))) end end ";

/// Whether the function that formats is there already.
const IS_THERE: &str = "function truncated(v)";

/// `simOMPL.compute` sets its task up by itself.
pub(super) fn setup_of_planning(text: &str) -> String {
    let whole = whole_words(text, COMPUTE);
    if whole.is_empty() || text.contains("setupAndCompute") {
        return text.to_owned();
    }
    let mut out = SETUP_AND_COMPUTE.to_owned();
    let mut end = 0;
    for at in whole {
        out.push_str(&text[end..at]);
        out.push_str("setupAndCompute(simOMPL)");
        end = at + COMPUTE.len();
    }
    out + &text[end..]
}

/// `string.format` truncates.
pub(super) fn truncating_format(text: &str) -> String {
    if !text.contains("format") || !formats_integers(text) || text.contains(IS_THERE) {
        return text.to_owned();
    }
    FORMAT.to_owned() + text
}

/// Whether there is something like `%5d` in it.
fn formats_integers(text: &str) -> bool {
    text.split('%').skip(1).any(|rest| {
        let kind = rest.trim_start_matches(|c: char| c.is_ascii_digit() || "-+ #.".contains(c));
        kind.starts_with(['d', 'i', 'u', 'o', 'x', 'X', 'c'])
    })
}

/// Where a word begins that is no part of a longer one.
fn whole_words(text: &str, word: &str) -> Vec<usize> {
    let is_whole = |at: &usize| {
        !text[..*at].ends_with(is_part) && !text[at + word.len()..].starts_with(is_part)
    };
    text.match_indices(word)
        .map(|(at, _)| at)
        .filter(is_whole)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{setup_of_planning, truncating_format};

    #[test]
    fn planning_is_set_up_first() {
        let new = setup_of_planning("local ok, path = simOMPL.compute(task, 4)");
        assert!(
            new.ends_with("local ok, path = setupAndCompute(simOMPL)(task, 4)"),
            "{new}"
        );
        assert!(!new.contains('\n'), "lines stay");
        assert_eq!(setup_of_planning(&new), new, "once");
        for text in [
            "mysimOMPL.compute(t)",
            "simOMPL.computeAll(t)",
            "simOMPL.solve(t)",
        ] {
            assert_eq!(setup_of_planning(text), text);
        }
    }

    #[test]
    fn only_texts_that_format_integers_get_the_old_function() {
        let new = truncating_format("print(('%5d'):format(x))");
        assert!(new.ends_with("print(('%5d'):format(x))") && !new.contains('\n'));
        assert_eq!(truncating_format(&new), new, "once");
        for text in ["string.format('%.2f', x)", "x = '%d'", "format()"] {
            assert_eq!(truncating_format(text), text);
        }
    }
}
