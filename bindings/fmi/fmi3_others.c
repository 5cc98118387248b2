/* What FMI 3.0 has and a unit of Fram has not: variables that are no real numbers, clocks and events, derivatives,
   model exchange and scheduled execution.  The standard wants every function to be there; these tell the log why they
   are errors, and look at nothing but the instance. */
#include "fmi3.h"
#include "unit.h"

#pragma GCC diagnostic ignored "-Wunused-parameter"
/* NOLINTBEGIN(readability-non-const-parameter,bugprone-easily-swappable-parameters): the standard has these */

#define NOT_OFFERED(name, ...) \
    fmi3Status fmi3##name(fmi3Instance c, __VA_ARGS__) { return (fmi3Status)unit_not_offered(c, #name); }
#define NOT_OFFERED_PLAIN(name) \
    fmi3Status fmi3##name(fmi3Instance c) { return (fmi3Status)unit_not_offered(c, #name); }

/* ---- other types of variables ---- */

#define OTHER_TYPE(type)                                                                                             \
    fmi3Status fmi3Get##type(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3##type v[], size_t m)       \
    {                                                                                                                \
        return (fmi3Status)unit_no_such_type(c, "Get" #type, n + m);                                                 \
    }                                                                                                                \
    fmi3Status fmi3Set##type(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3##type v[], size_t m) \
    {                                                                                                                \
        return (fmi3Status)unit_no_such_type(c, "Set" #type, n + m);                                                 \
    }
OTHER_TYPE(Float32)
OTHER_TYPE(Int8)
OTHER_TYPE(UInt8)
OTHER_TYPE(Int16)
OTHER_TYPE(UInt16)
OTHER_TYPE(Int32)
OTHER_TYPE(UInt32)
OTHER_TYPE(Int64)
OTHER_TYPE(UInt64)
OTHER_TYPE(Boolean)
OTHER_TYPE(String)

fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference r[], size_t n, size_t sizes[], fmi3Binary v[],
                         size_t m)
{
    return (fmi3Status)unit_no_such_type(c, "GetBinary", n + m);
}
fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference r[], size_t n, const size_t sizes[],
                         const fmi3Binary v[], size_t m)
{
    return (fmi3Status)unit_no_such_type(c, "SetBinary", n + m);
}
fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Clock v[])
{
    return (fmi3Status)unit_no_such_type(c, "GetClock", n);
}
fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Clock v[])
{
    return (fmi3Status)unit_no_such_type(c, "SetClock", n);
}

/* ---- modes, events and clocks ---- */

NOT_OFFERED_PLAIN(EnterEventMode)
NOT_OFFERED_PLAIN(EnterStepMode)
NOT_OFFERED_PLAIN(EnterConfigurationMode)
NOT_OFFERED_PLAIN(ExitConfigurationMode)
NOT_OFFERED_PLAIN(EvaluateDiscreteStates)
NOT_OFFERED(UpdateDiscreteStates, fmi3Boolean *update, fmi3Boolean *terminate, fmi3Boolean *nominals,
            fmi3Boolean *values, fmi3Boolean *has_next, fmi3Float64 *next)
NOT_OFFERED(GetIntervalDecimal, const fmi3ValueReference r[], size_t n, fmi3Float64 v[], fmi3IntervalQualifier q[])
NOT_OFFERED(GetIntervalFraction, const fmi3ValueReference r[], size_t n, fmi3UInt64 v[], fmi3UInt64 w[],
            fmi3IntervalQualifier q[])
NOT_OFFERED(GetShiftDecimal, const fmi3ValueReference r[], size_t n, fmi3Float64 v[])
NOT_OFFERED(GetShiftFraction, const fmi3ValueReference r[], size_t n, fmi3UInt64 v[], fmi3UInt64 w[])
NOT_OFFERED(SetIntervalDecimal, const fmi3ValueReference r[], size_t n, const fmi3Float64 v[])
NOT_OFFERED(SetIntervalFraction, const fmi3ValueReference r[], size_t n, const fmi3UInt64 v[], const fmi3UInt64 w[])
NOT_OFFERED(SetShiftDecimal, const fmi3ValueReference r[], size_t n, const fmi3Float64 v[])
NOT_OFFERED(SetShiftFraction, const fmi3ValueReference r[], size_t n, const fmi3UInt64 v[], const fmi3UInt64 w[])
NOT_OFFERED(ActivateModelPartition, fmi3ValueReference clock, fmi3Float64 time)

/* ---- derivatives and dependencies ---- */

NOT_OFFERED(GetDirectionalDerivative, const fmi3ValueReference a[], size_t n, const fmi3ValueReference b[], size_t m,
            const fmi3Float64 d[], size_t k, fmi3Float64 out[], size_t l)
NOT_OFFERED(GetAdjointDerivative, const fmi3ValueReference a[], size_t n, const fmi3ValueReference b[], size_t m,
            const fmi3Float64 d[], size_t k, fmi3Float64 out[], size_t l)
NOT_OFFERED(GetOutputDerivatives, const fmi3ValueReference r[], size_t n, const fmi3Int32 o[], fmi3Float64 v[],
            size_t m)
NOT_OFFERED(GetNumberOfVariableDependencies, fmi3ValueReference r, size_t *n)
NOT_OFFERED(GetVariableDependencies, fmi3ValueReference r, size_t e[], fmi3ValueReference i[], size_t f[],
            fmi3DependencyKind k[], size_t n)

/* ---- model exchange ---- */

NOT_OFFERED_PLAIN(EnterContinuousTimeMode)
NOT_OFFERED(CompletedIntegratorStep, fmi3Boolean no_set_before, fmi3Boolean *event, fmi3Boolean *terminate)
NOT_OFFERED(SetTime, fmi3Float64 time)
NOT_OFFERED(SetContinuousStates, const fmi3Float64 v[], size_t n)
NOT_OFFERED(GetContinuousStateDerivatives, fmi3Float64 v[], size_t n)
NOT_OFFERED(GetEventIndicators, fmi3Float64 v[], size_t n)
NOT_OFFERED(GetContinuousStates, fmi3Float64 v[], size_t n)
NOT_OFFERED(GetNominalsOfContinuousStates, fmi3Float64 v[], size_t n)
NOT_OFFERED(GetNumberOfEventIndicators, size_t *n)
NOT_OFFERED(GetNumberOfContinuousStates, size_t *n)

/* NOLINTEND(readability-non-const-parameter,bugprone-easily-swappable-parameters) */
