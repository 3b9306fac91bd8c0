# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""
    domain, wells = wellknit_jutul(file)

Loads what `wellknit --write mrst=FILE` wrote, for JutulDarcy: the reservoir with our transmissibilities (connections
without a face too), and its wells with our well indices. Needs the packages Jutul, JutulDarcy and MAT.

    model, parameters = setup_reservoir_model(domain, system, wells = wells)
"""
module WellknitJutul

using Jutul, JutulDarcy, MAT

export wellknit_jutul

# A struct array comes as an array of dictionaries or as a dictionary of arrays, by the version of MAT.
count_of(wells) = wells isa AbstractArray ? length(wells) : (wells["name"] isa AbstractArray ? length(wells["name"]) : 1)

function field(wells, name, i)
    wells isa AbstractArray && return wells[i][name]
    values = wells[name]
    return count_of(wells) > 1 || (values isa AbstractArray && eltype(values) == Any) ? values[i] : values
end

column(value::Number) = [value]
column(value) = vec(value)

function wellknit_jutul(file::AbstractString)
    domain, data = JutulDarcy.reservoir_domain_from_mrst(String(file), extraout = true)
    wells = []
    haskey(data, "W") || return domain, wells
    table = data["W"]
    for i in 1:count_of(table)
        cells = Int.(column(field(table, "cells", i)))
        isempty(cells) && continue
        push!(wells, setup_well(domain, cells,
            name = Symbol(field(table, "name", i)),
            WI = Float64.(column(field(table, "WI", i))),
            radius = Float64(first(column(field(table, "r", i)))),
            reference_depth = Float64(field(table, "refDepth", i)),
            simple_well = true))
    end
    return domain, wells
end

end
