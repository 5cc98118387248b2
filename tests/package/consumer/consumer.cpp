// The public headers are C++ too.
#include <fram/error.h>
#include <fram/fram.h>
#include <fram/version.h>

int main()
{
    return fram_version()[0] == '0' ? 0 : 1;
}
