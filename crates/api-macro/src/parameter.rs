//! The parameters of a scriptable function: their names for scripts, and their defaults.

use proc_macro2::TokenStream as Tokens;
use quote::quote;
use syn::parse::{Parse, ParseStream};
use syn::{Attribute, Expr, FnArg, LitStr, Pat, PatType, Token, Type};

pub(crate) struct Parameter {
    pub(crate) ident: syn::Ident,
    /// The name scripts see.
    pub(crate) name: String,
    ty: Type,
    default: Option<Default>,
}

/// `expr`, or `expr, "sim.constant"`.
struct Default {
    value: Expr,
    constant: Option<LitStr>,
}

impl Parse for Default {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let value = input.parse()?;
        let constant = match input.parse::<Option<Token![,]>>()? {
            Some(_) => Some(input.parse()?),
            None => None,
        };
        Ok(Self { value, constant })
    }
}

impl Parameter {
    /// Reads a parameter, and removes the attributes that are for `#[api]` alone.
    pub(crate) fn take(input: &mut FnArg, is_snake_case: bool) -> syn::Result<Self> {
        let FnArg::Typed(PatType { attrs, pat, ty, .. }) = input else {
            return Err(syn::Error::new_spanned(input, "`self` is not scriptable"));
        };
        let Pat::Ident(pat) = &**pat else {
            return Err(syn::Error::new_spanned(pat, "parameters need a plain name"));
        };
        let ident = pat.ident.clone();
        let default = take_attribute(attrs, "default")?;
        let name = match take_attribute::<LitStr>(attrs, "name")? {
            Some(name) => name.value(),
            None => script_name(&ident.to_string(), is_snake_case),
        };
        Ok(Self {
            ident,
            name,
            ty: (**ty).clone(),
            default,
        })
    }

    /// The row for the reference.
    pub(crate) fn row(&self) -> Tokens {
        let Self {
            name, ty, default, ..
        } = self;
        let Some(Default { value, constant }) = default else {
            return quote!(Param::new::<#ty>(#name));
        };
        let constant = constant
            .as_ref()
            .map_or_else(|| quote!(None), |name| quote!(Some(#name)));
        quote! {
            Param::optional::<#ty>(#name, DefaultValue {
                value: || {
                    let value: #ty = (#value).into();
                    value.into()
                },
                constant: #constant,
            })
        }
    }

    pub(crate) fn decoder(&self) -> Tokens {
        let Self { ident, ty, .. } = self;
        match &self.default {
            Some(Default { value, .. }) => {
                quote!(let #ident: #ty = args.take_or(|| (#value).into())?;)
            }
            None => quote!(let #ident: #ty = args.take()?;),
        }
    }
}

fn take_attribute<T: Parse>(attributes: &mut Vec<Attribute>, name: &str) -> syn::Result<Option<T>> {
    match attributes
        .iter()
        .position(|attribute| attribute.path().is_ident(name))
    {
        Some(at) => attributes.remove(at).parse_args().map(Some),
        None => Ok(None),
    }
}

/// The name that scripts see without `#[name]`. The underscore of an unused parameter and `r#` mean something to Rust alone.
fn script_name(rust_name: &str, is_snake_case: bool) -> String {
    let name = rust_name.trim_start_matches("r#").trim_start_matches('_');
    if is_snake_case {
        name.to_owned()
    } else {
        camel_case(name)
    }
}

fn camel_case(snake: &str) -> String {
    let mut words = snake.split('_');
    let mut out = words.next().unwrap_or_default().to_owned();
    for word in words {
        let mut letters = word.chars();
        out.extend(letters.next().map(|c| c.to_ascii_uppercase()));
        out.push_str(letters.as_str());
    }
    out
}
